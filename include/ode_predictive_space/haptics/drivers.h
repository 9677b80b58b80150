// Devices by name, and devices with drivers.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DRIVERS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DRIVERS_H

#include "ode_predictive_space/haptics/device.h"

#include <memory>
#include <vector>

namespace ode_predictive_space::haptics
{
/// The names that make_device() accepts: "virtual", "hand-path", "replay:FILE", "mouse", "spacenav", "openhaptics".
const std::vector<std::string> &device_names();

/// Makes a device, not yet open.
///
/// The device has default settings. The hand of "virtual" follows a HandPath in the workspace; "mouse" needs input
/// events.
/// @param seed of the hand's path, for the first two.
/// @throws std::invalid_argument for another name; the message lists the names.
std::unique_ptr<Device> make_device(const std::string &name, std::uint64_t seed = 1);

/// Selection of the library and the arm.
struct OpenHapticsSettings
{
    /// File of OpenHaptics' HD library, as dlopen() takes it. Empty: libHD.so, else libHD.so.3.0, wherever the dynamic
    /// linker finds them (LD_LIBRARY_PATH, /etc/ld.so.conf).
    std::string library;

    /// The arm's name in the driver's configuration. Empty: the driver's default arm.
    std::string configuration;
};

/// An arm of OpenHaptics' HD library, which is loaded at run time and not needed for building.
///
/// **This has never run on hardware.** It was tested against a stand-in for the library only.
///
/// The library calls this class in its servo thread, about 1000 times a second, to take the arm's state and set the
/// last force; read() and write() exchange them with that thread without locks or waits.
///
/// Force. The library repeats the last force. Therefore the next frame sets zero
/// - after `force_timeout` without a write(), counted in the servo's frames: a slower loop gets no force;
/// - after any error that the library reports in the servo thread;
/// - when the device is closed or destroyed, or open() fails: after one more frame the scheduler is stopped, the
///   callback unscheduled, and the arm switched off. Each wait is bounded: if the servo thread hangs, the force output
///   is switched off without it. The library's clamping and ramping of forces are enabled. Torques are ignored.
///
/// Errors of the library in the servo thread:
/// - WARM_MOTORS, EXCEEDED_MAX_FORCE, EXCEEDED_MAX_FORCE_IMPULSE, EXCEEDED_MAX_VELOCITY, FORCE_ERROR: it recovers. The
///   next read() or write() throws `failed`. Until `recovery_time` has passed without such an error, no force is
///   rendered, read() throws, and status() is not ready; writes after the first succeed, so that zero can be written.
///   After that the force should grow slowly, as after a start.
/// - DEVICE_FAULT, DEVICE_ALREADY_INITIATED, COMM_ERROR, COMM_CONFIG_ERROR, TIMER_ERROR, BAD_HANDLE: read() and write()
///   throw `lost` until close().
/// - all others: they throw `failed` until close(). A servo thread that does not run for `silence_timeout`, on the
///   clock of read(), counts as COMM_ERROR.
class OpenHapticsDevice final : public Device
{
public:
    static constexpr double force_timeout = 0.01;  ///< s
    static constexpr double recovery_time = 0.1;   ///< s
    static constexpr double silence_timeout = 0.1; ///< s

    /// Does not load the library: open() does.
    explicit OpenHapticsDevice(OpenHapticsSettings settings = {});
    ~OpenHapticsDevice() override;

    /// Loads the library and opens the arm; does nothing when it is open. One device can be open at a time, because the
    /// library has one scheduler.
    ///
    /// @throws DeviceError missing_library (with the dynamic linker's words), missing_symbol, not_found,
    /// not_calibrated, permission_denied (another one is open), failed; with the library's error code, its name and its
    /// words where it gave one.
    void open() override;
    void close() noexcept override;
    const Capabilities &capabilities() const override { return capabilities_; }

    /// @throws DeviceError also for a force that is not finite (failed), in place of which zero is rendered.
    void write(const Wrench &wrench) override;

    /// The state has the time of the first read() that returned it.
    DeviceState read(double time) override;
    DeviceStatus status() const override;

private:
    class Session;

    OpenHapticsSettings settings_;
    Capabilities capabilities_;
    std::unique_ptr<Session> session_;
};

/// Mapping of the cap's deflection to motion. All > 0, but dead_zone >= 0.
struct SpacenavSettings
{
    double speed = 0.1;            ///< m/s at full deflection
    double turn_rate = 1.0;        ///< rad/s at full deflection
    double dead_zone = 0.05;       ///< < 1; ignored part of full deflection, per axis
    double workspace_extent = 0.1; ///< m; maximum distance from the origin, per axis
};

/// A 3D mouse, through libspnav and a running spacenavd.
///
/// **This has never run on hardware.** It was tested against a stand-in for spacenavd only.
///
/// The cap's deflection is a rate: read() integrates it to a position, which starts at the origin and stops at the
/// workspace's walls, and to an orientation. A longer pause between two reads counts as `longest_step`. write() is
/// ignored. One device can be open at a time, because libspnav has one connection.
///
/// The environment variable SPNAV_SOCKET replaces the socket /var/run/spnav.sock, without a fallback. open() throws
/// DeviceError missing_library (built without libspnav), missing_file (no server at the socket), permission_denied (for
/// the socket, because libspnav's connection is in use, or because SPNAV_SOCKET is set in a set-user-ID program),
/// not_found (the server has no mouse), lost.
class SpacenavDevice final : public SoftwareDevice
{
public:
    static constexpr double longest_step = 0.05;   ///< s
    static constexpr double full_deflection = 350; ///< in the server's counts

    /// @throws std::invalid_argument when a setting is out of its range.
    explicit SpacenavDevice(const SpacenavSettings &settings = {});
    ~SpacenavDevice() override;

    void close() noexcept override;

    /// @throws DeviceError lost, also for an unplugged mouse; so does read(), until close().
    void write(const Wrench &wrench) override;

protected:
    void start() override;
    DeviceState move_to(double seconds) override;
    std::string idle_reason() const override;

private:
    struct Session;

    void check_connection() const;

    SpacenavSettings settings_;
    std::unique_ptr<Session> session_; ///< while it is open
};
} // namespace ode_predictive_space::haptics

#endif
