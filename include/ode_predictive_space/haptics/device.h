// The interface of haptic devices.

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

/// Properties of a device, in SI units and the device's own frame: x to the right, y up, z towards the person.
struct Capabilities
{
    std::string name;         ///< for people: maker and model
    int input_axes = 3;       ///< 3: positions; 6: positions and orientations
    int force_axes = 3;       ///< 0: none; 3: forces; 6: forces and torques
    double max_force = 0;     ///< N; 0: unknown
    double max_stiffness = 0; ///< N/m; of a wall that is stable at the nominal rate; 0: unknown
    double max_damping = 0;   ///< N s/m; likewise; 0: unknown
    double rate = 1000;       ///< Hz; nominal rate of the servo
    Eigen::AlignedBox3d workspace{Vector3::Constant(-0.1), Vector3::Constant(0.1)}; ///< m; within reach of the hand
    double delay = 0; ///< s; of device and driver, from a position to its force, beyond the loop's period
};

/// State of the handle of a device, in SI units and the device's own frame.
struct DeviceState
{
    Vector3 position = Vector3::Zero();              ///< m
    Quaternion orientation = Quaternion::Identity(); ///< of the handle; identity for a device without orientations
    Vector3 linear_velocity = Vector3::Zero();       ///< m/s
    Vector3 angular_velocity = Vector3::Zero();      ///< rad/s
    std::uint32_t buttons = 0;                       ///< bit i set: button i is held
    double time = 0;                                 ///< s; of this state, on the clock of read()
};

/// State of the probe, in SI units and the scene's frame.
struct ToolState
{
    Vector3 position = Vector3::Zero();              ///< m
    Quaternion orientation = Quaternion::Identity(); ///< of length 1
    Vector3 linear_velocity = Vector3::Zero();       ///< m/s
    Vector3 angular_velocity = Vector3::Zero();      ///< rad/s
};

/// Force and torque of a device on the hand, in the device's own frame.
struct Wrench
{
    Vector3 force = Vector3::Zero();  ///< N
    Vector3 torque = Vector3::Zero(); ///< N m; ignored by devices of less than 6 force axes
};

/// Kinds of faults of a device.
enum class DeviceFault
{
    missing_library,   ///< the vendor's library, or one that it needs, cannot be loaded
    missing_symbol,    ///< a function of the library is missing: another version
    missing_file,      ///< a recording or a socket does not exist
    bad_file,          ///< a recording cannot be understood
    permission_denied, ///< a file, a socket or a port must not be opened
    not_found,         ///< the driver finds no device
    not_calibrated,    ///< the device has to be calibrated by hand first
    lost,              ///< it no longer answers
    failed,            ///< it reports a fault: warm motors, excessive force, its safety switch
    not_open           ///< read() or write() before open() or after close()
};

/// The name of the enumerator.
const char *name_of(DeviceFault fault);

/// Exception of devices. what() is one sentence that names the device and the library, symbol, file or code at fault.
class DeviceError : public std::runtime_error
{
public:
    /// @param message one sentence; what() gives it.
    DeviceError(DeviceFault fault, const std::string &message) : std::runtime_error(message), fault_(fault) {}
    /// The kind of fault.
    DeviceFault fault() const { return fault_; }

private:
    DeviceFault fault_;
};

/// Status of a device, for people and for a watchdog.
struct DeviceStatus
{
    bool open = false;       ///< between open() and close()
    bool ready = false;      ///< read() and write() are effective
    std::string explanation; ///< one sentence if it is not ready; otherwise empty
};

/// A haptic device, or software in place of one.
///
/// Call order: open(); read() and write() in each tick, from the servo's thread; close(). When that thread hangs
/// elsewhere, another one may write() zero, or close(); two threads never call at once. A written force persists until
/// the next write() or close().
///
/// When the program ends by exit(), an uncaught exception or abort(), zero is written from there: within a call of the
/// device if the program ends in one, and beside a call of another thread that does not return within 20 ms. If the
/// device then waits for a lock, the program is killed after a second.
class Device
{
public:
    virtual ~Device() = default; ///< derived classes do as close()

    /// Opens the device. @throws DeviceError when the device cannot be used; it is then not open.
    virtual void open() = 0;

    /// Sets zero force, and releases the device. Does nothing when it is not open.
    virtual void close() noexcept = 0;

    /// The properties of the device; before open(), those that are usual for its class.
    virtual const Capabilities &capabilities() const = 0;

    /// Reads the latest state.
    ///
    /// @param time s, on the loop's clock; not less than in the call before. Simulated devices move by it.
    /// @throws DeviceError (lost, failed, not_open). The last force may persist, so the caller writes zero.
    virtual DeviceState read(double time) = 0;

    /// Sets force and torque. The caller keeps them within the capabilities: see SafetyLimits.
    ///
    /// @throws DeviceError (lost, failed, not_open).
    virtual void write(const Wrench &wrench) = 0;

    /// The present status. For the servo's thread.
    virtual DeviceStatus status() const = 0;
};

/// A device without hardware, which moves by the time of read(). Its motion begins at the first read() after open().
class SoftwareDevice : public Device
{
public:
    void open() override;
    void close() noexcept override;
    const Capabilities &capabilities() const override { return capabilities_; }

    /// @param time s. @throws std::invalid_argument for a time that is not finite; DeviceError (not_open).
    DeviceState read(double time) override;

    /// @throws DeviceError: not_open; failed for a wrench that is not finite, which sets the last wrench to zero.
    void write(const Wrench &wrench) override;

    DeviceStatus status() const override;

    /// The last written wrench; zero before the first and after close().
    const Wrench &last_wrench() const { return last_wrench_; }

protected:
    /// Makes a device that is not open.
    explicit SoftwareDevice(Capabilities capabilities) : capabilities_(std::move(capabilities)) {}

    /// Makes a device that renders no force.
    SoftwareDevice(const std::string &name, int input_axes,
                   const Eigen::AlignedBox3d &workspace = Capabilities().workspace);

    /// Returns to the beginning of the motion. The device is not open if this throws.
    virtual void start() {}

    /// The state at `seconds` (s) after the first read(), not less than in the call before. The caller sets the state's
    /// time.
    virtual DeviceState move_to(double seconds) = 0;

    /// The reason for which an open device is not ready, or an empty string.
    virtual std::string idle_reason() const { return {}; }

    Capabilities capabilities_; ///< result of capabilities()

private:
    void check_open(const char *call) const;

    bool open_ = false;
    std::optional<double> first_time_; ///< s; of the first read()
    double last_seconds_ = 0;          ///< since then
    Wrench last_wrench_;
};
} // namespace ode_predictive_space::haptics

#endif
