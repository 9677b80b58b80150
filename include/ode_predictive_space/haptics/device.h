// What a haptic device is to the rest of the library.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_H

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace ode_predictive_space::haptics
{
/// Each use states unit and frame.
using Vector3 = Eigen::Vector3d;

/// Converts from and to Eigen::Quaterniond. Not aligned, or the layout of this library's structs would depend on how a program is
/// compiled.
using Quaternion = Eigen::Quaternion<double, Eigen::DontAlign>;

/// What a device can do. All in SI units, in the device's own frame: x to the right, y up, z towards the person.
struct Capabilities
{
    std::string name;         ///< for people: maker and model
    int input_axes = 3;       ///< 3 when it tells positions, 6 when orientations, too
    int force_axes = 3;       ///< 0 when it cannot push, 3 for forces, 6 for torques, too
    double max_force = 0;     ///< N; that it can render at all
    double max_stiffness = 0; ///< N/m; of a wall that it can render stably at its nominal rate
    double max_damping = 0;   ///< N s/m; the same
    double rate = 1000;       ///< Hz; nominal rate of its servo loop
    Eigen::AlignedBox3d workspace{Vector3::Constant(-0.1), Vector3::Constant(0.1)}; ///< m; within reach of the hand
    double delay = 0; ///< s; from a position to its force, by device and driver, beyond the loop's own period
};

/// Where the handle of a device is. SI units, the device's own frame.
struct DeviceState
{
    Vector3 position = Vector3::Zero();              ///< m
    Quaternion orientation = Quaternion::Identity(); ///< of the handle; identity where the device does not tell
    Vector3 linear_velocity = Vector3::Zero();       ///< m/s
    Vector3 angular_velocity = Vector3::Zero();      ///< rad/s
    std::uint32_t buttons = 0;                       ///< bit i set: button i is held
    double time = 0;                                 ///< s; when this was so, on the clock that read() was given
};

/// The probe, in the scene's frame, SI units.
struct ToolState
{
    Vector3 position = Vector3::Zero();              ///< m
    Quaternion orientation = Quaternion::Identity(); ///< of length 1
    Vector3 linear_velocity = Vector3::Zero();       ///< m/s
    Vector3 angular_velocity = Vector3::Zero();      ///< rad/s
};

/// What a device is to push the hand with. The device's own frame.
struct Wrench
{
    Vector3 force = Vector3::Zero();  ///< N
    Vector3 torque = Vector3::Zero(); ///< N m; ignored by devices of less than 6 force axes
};

/// Why a device does not work.
enum class DeviceFault
{
    missing_library,   ///< the vendor's library, or one that it needs, cannot be loaded
    missing_symbol,    ///< the library is there and lacks a function: another version
    missing_file,      ///< a recording or a socket is not there
    bad_file,          ///< a recording cannot be understood
    permission_denied, ///< a file, a socket or a port is there and must not be opened
    not_found,         ///< the driver is there, the device is not
    not_calibrated,    ///< the device has to be calibrated by hand first
    lost,              ///< it worked, and answers no more
    failed,            ///< it reports a fault of its own: motors too warm, too much force, its safety switch
    not_open           ///< read() or write() before open() or after close()
};

/// The name of a fault, as it is written above.
const char *name_of(DeviceFault fault);

/// Thrown by devices. what() is one sentence that names the device and the library, symbol, file or code that is to blame.
class DeviceError : public std::runtime_error
{
public:
    /// @param message one sentence; what() gives it.
    DeviceError(DeviceFault fault, const std::string &message) : std::runtime_error(message), fault_(fault) {}
    /// What kind of fault it is: whether it may pass by itself.
    DeviceFault fault() const { return fault_; }

private:
    DeviceFault fault_;
};

/// How a device is, for people and for a watchdog.
struct DeviceStatus
{
    bool open = false;       ///< between open() and close()
    bool ready = false;      ///< read() and write() do something useful now
    std::string explanation; ///< why it is not, in one sentence; empty when it is
};

/// A haptic device, or something that stands for one.
///
/// Call order: open(); then read() and write() in each tick, from the servo loop's thread; close(). When that thread hangs
/// elsewhere, another one may write() zero, or close(): never two at once. A force that was written stays
/// until the next write() or close().
///
/// When the program ends, by exit(), an exception that is not caught or abort(), zero is written from there: within a call of the
/// device where the program ends in one, and beside a call of another thread that does not return within 20 ms. A device that
/// waits for a lock of its own then is given up after a second, and the program is killed.
class Device
{
public:
    virtual ~Device() = default; ///< of derived classes: as close() does

    /// @throws DeviceError when the device cannot be used; it is then as if open() had not been called.
    virtual void open() = 0;

    /// Render no force and release the device. Never throws; does nothing when it is not open.
    virtual void close() noexcept = 0;

    /// Known after open(); before that, what its class of devices can usually do.
    virtual const Capabilities &capabilities() const = 0;

    /// The latest state.
    ///
    /// @param time seconds on the loop's clock, not less than in the call before. Devices without hardware move by it;
    /// others only note it.
    /// @throws DeviceError (lost, failed, not_open). The last force that was written may still be there: write zero.
    virtual DeviceState read(double time) = 0;

    /// Push the hand. What goes beyond the device's capabilities is the caller's fault: see SafetyLimits.
    ///
    /// @throws DeviceError (lost, failed, not_open).
    virtual void write(const Wrench &wrench) = 0;

    /// May be called at any time, from the servo loop's thread.
    virtual DeviceStatus status() const = 0;
};

/// A device that is made of software: it can always be opened, unless start() objects, and moves by the time that read() is
/// given. Its motion begins at the first read() after open(), whatever the loop's clock shows then.
class SoftwareDevice : public Device
{
public:
    void open() override;
    void close() noexcept override;
    const Capabilities &capabilities() const override { return capabilities_; }

    /// @throws std::invalid_argument for a time that is not finite; DeviceError (not_open).
    DeviceState read(double time) override;

    /// @throws DeviceError: not_open; failed for a wrench that is not finite. The last wrench is zero then.
    void write(const Wrench &wrench) override;

    DeviceStatus status() const override;

    /// What was written last; zero before that and after close().
    const Wrench &last_wrench() const { return last_wrench_; }

protected:
    /// Not open.
    explicit SoftwareDevice(Capabilities capabilities) : capabilities_(std::move(capabilities)) {}

    /// Of a device that renders no force.
    SoftwareDevice(const std::string &name, int input_axes,
                   const Eigen::AlignedBox3d &workspace = Capabilities().workspace);

    /// Go back to the beginning of the motion. The device is not open if this throws.
    virtual void start() {}

    /// Move on to `seconds` after the first read(), for which it is 0; never less than in the call before. The caller sets
    /// the state's time.
    virtual DeviceState move_to(double seconds) = 0;

    /// Why the device, open, is not ready; empty when it is.
    virtual std::string idle_reason() const { return {}; }

    Capabilities capabilities_; ///< what capabilities() tells

private:
    void check_open(const char *call) const;

    bool open_ = false;
    std::optional<double> first_time_; ///< s; of the first read()
    double last_seconds_ = 0;          ///< since then
    Wrench last_wrench_;
};
} // namespace ode_predictive_space::haptics

#endif
