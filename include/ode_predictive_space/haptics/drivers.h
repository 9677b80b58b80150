// Devices by name, as command lines give them, and those that a driver serves.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DRIVERS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DRIVERS_H

#include "ode_predictive_space/haptics/device.h"

#include <memory>
#include <vector>

namespace ode_predictive_space::haptics
{
/// What make_device() knows: "virtual", "hand-path", "replay:FILE", "mouse", "spacenav", "openhaptics".
const std::vector<std::string> &device_names();

/// A device, not yet open.
///
/// Each is of the class that its name tells, with the default settings. The hand of "virtual" wants to follow a HandPath in the
/// workspace; "mouse" wants to be fed.
/// @param seed of the hand's path, for the first two.
/// @throws std::invalid_argument for another name; the message lists the names.
std::unique_ptr<Device> make_device(const std::string &name, std::uint64_t seed = 1);

/// Which arm, through which library.
struct OpenHapticsSettings
{
    /// File of OpenHaptics' HD library, as dlopen() takes it. Empty: libHD.so, else libHD.so.3.0, wherever the dynamic
    /// linker finds them (LD_LIBRARY_PATH, /etc/ld.so.conf).
    std::string library;

    /// The arm's name in the driver's configuration. Empty: the driver's default arm.
    std::string configuration;
};

/// An arm behind OpenHaptics' HD library, which is loaded at run time: nothing of it is needed to build this.
///
/// **This has never run on hardware.** It was tested against a stand-in for the library only.
///
/// The library calls us in a servo thread of its own, about 1000 times a second. There the arm's state is taken and the
/// last force is set; read() and write() exchange them with that thread without locks, and never wait.
///
/// Force. The library keeps playing the last force that it was given. Therefore zero takes its place in the next frame
/// - when no write() came for `force_timeout`, counted in the servo's frames: a loop slower than that gets no force;
/// - after any error that the library reports in the servo thread;
/// - when the device is closed or destroyed, or open() fails half way: zero is set and seen by one more frame; then the
///   scheduler is stopped, the callback unscheduled, and the arm switched off. Each of these waits is bounded: when the
///   servo thread stands still, the force output is switched off without it.
/// The library's own clamping and ramping of forces are switched on. Torques are ignored.
///
/// Errors of the library in the servo thread, by their names in it:
/// - WARM_MOTORS, EXCEEDED_MAX_FORCE, EXCEEDED_MAX_FORCE_IMPULSE, EXCEEDED_MAX_VELOCITY, FORCE_ERROR: it recovers. The
///   next read() or write() throws `failed`. No force is rendered until `recovery_time` has gone by without such an
///   error; as long, read() throws, and status() is not ready. Writes after the first go through, for a zero. After
///   that the force should grow slowly, as after a start.
/// - DEVICE_FAULT, DEVICE_ALREADY_INITIATED, COMM_ERROR, COMM_CONFIG_ERROR, TIMER_ERROR, BAD_HANDLE: read() and write()
///   throw `lost` until close().
/// - any other: they throw `failed` until close().
/// The same as COMM_ERROR is a servo thread that does not run for `silence_timeout` on the clock of read().
class OpenHapticsDevice final : public Device
{
public:
    static constexpr double force_timeout = 0.01;  ///< s
    static constexpr double recovery_time = 0.1;   ///< s
    static constexpr double silence_timeout = 0.1; ///< s

    /// Loads nothing: open() does.
    explicit OpenHapticsDevice(OpenHapticsSettings settings = {});
    ~OpenHapticsDevice() override;

    /// Does nothing when it is open. One device can be open at a time, because the library has one scheduler.
    ///
    /// @throws DeviceError missing_library (with the dynamic linker's words), missing_symbol, not_found,
    /// not_calibrated, permission_denied (another one is open), failed; with the library's error code, its name and its
    /// words where it gave one.
    void open() override;
    void close() noexcept override;
    const Capabilities &capabilities() const override { return capabilities_; }

    /// @throws DeviceError also when the force is not finite (failed); zero is rendered then.
    void write(const Wrench &wrench) override;

    /// The time of the state is that of the first read() that saw it.
    DeviceState read(double time) override;
    DeviceStatus status() const override;

private:
    class Session;

    OpenHapticsSettings settings_;
    Capabilities capabilities_;
    std::unique_ptr<Session> session_;
};

/// How the deflection of the cap moves the handle. All > 0, but dead_zone >= 0.
struct SpacenavSettings
{
    double speed = 0.1;            ///< m/s at full deflection
    double turn_rate = 1.0;        ///< rad/s at full deflection
    double dead_zone = 0.05;       ///< < 1; the part of full deflection, per axis, that counts as none
    double workspace_extent = 0.1; ///< m; the position stays within this far from the origin, per axis
};

/// A 3D mouse, through libspnav and a running spacenavd.
///
/// **This has never run on hardware.** It was tested against a stand-in for spacenavd only.
///
/// The cap's deflection is a rate: read() integrates it to a position, which starts at the origin and stops at the
/// workspace's walls, and to an orientation. A pause of more than `longest_step` between two reads counts as that.
/// There is no force: write() is accepted and ignored. One device can be open at a time, because libspnav has one connection for
/// the whole program.
///
/// The environment variable SPNAV_SOCKET names another server than that at /var/run/spnav.sock. If it is set and does
/// not answer, open() fails; there is no falling back. open() throws DeviceError missing_library (this was built without
/// libspnav), missing_file (no server at the socket), permission_denied (the socket's, libspnav's connection is taken, or
/// SPNAV_SOCKET is set in a set-user-ID program), not_found (the server has no mouse), lost.
class SpacenavDevice final : public SoftwareDevice
{
public:
    static constexpr double longest_step = 0.05;   ///< s
    static constexpr double full_deflection = 350; ///< in the server's counts; what the mice tell at their stop

    /// @throws std::invalid_argument when a setting is out of its range.
    explicit SpacenavDevice(const SpacenavSettings &settings = {});
    ~SpacenavDevice() override;

    void close() noexcept override;

    /// @throws DeviceError lost, also when a mouse is unplugged; read() does the same, until close().
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
