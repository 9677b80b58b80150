// A device that follows a test's path, and a log of what is written to a device.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_SCRIPTED_DEVICE_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_SCRIPTED_DEVICE_H

#include "ode_predictive_space/haptics/device.h"
#include "ode_predictive_space/haptics/loop.h"

#include <functional>
#include <vector>

namespace ode_predictive_space::haptics
{
/// The figures of a PHANToM Desktop.
inline Capabilities desktop_capabilities()
{
    Capabilities capabilities;
    capabilities.name = "scripted device";
    capabilities.max_force = 7.9;
    capabilities.max_stiffness = 1000;
    capabilities.max_damping = 5;
    return capabilities;
}

inline Wrench push(double newtons)
{
    Wrench wrench;
    wrench.force.z() = newtons;
    return wrench;
}

/// Settings of a loop in simulated time, without real-time priority. @param duration s. @param physics_rate Hz; if decoupled.
inline LoopSettings simulated(LoopClock &clock, double duration, bool decoupled = false, double physics_rate = 1000)
{
    LoopSettings settings;
    settings.decoupled = decoupled;
    settings.physics_rate = physics_rate;
    settings.duration = duration;
    settings.ask_for_priority = false;
    settings.clock = &clock;
    return settings;
}

/// Written forces do not move it.
class ScriptedDevice : public SoftwareDevice
{
public:
    using Path = std::function<Vector3(double seconds)>;

    explicit ScriptedDevice(Path path, const Capabilities &capabilities = desktop_capabilities())
        : SoftwareDevice(capabilities), path_(std::move(path))
    {}

    std::function<void()> before_read; ///< called within the driver; may be empty
    std::uint32_t buttons = 0;

protected:
    DeviceState move_to(double seconds) override
    {
        constexpr double step = 1e-4;
        if (before_read)
            before_read();
        DeviceState state;
        state.position = path_(seconds);
        state.buttons = buttons;
        state.linear_velocity = (path_(seconds + step) - state.position) / step;
        return state;
    }

private:
    Path path_;
};

struct LoggedWrite
{
    double time; ///< s; on the log's clock
    Wrench wrench;
};

/// Passes all calls to a device, and records its writes. Several threads may write, one at a time.
class WriteLog : public Device
{
public:
    WriteLog(Device &device, const LoopClock &clock) : device_(device), clock_(clock) {}

    void open() override { device_.open(); }
    void close() noexcept override
    {
        device_.close();
        log(Wrench());
    }
    const Capabilities &capabilities() const override { return device_.capabilities(); }
    DeviceState read(double time) override { return device_.read(time); }
    DeviceStatus status() const override { return device_.status(); }

    void write(const Wrench &wrench) override
    {
        device_.write(wrench);
        log(wrench);
    }

    const std::vector<LoggedWrite> &writes() const { return writes_; }

    Vector3 force_at(double time) const
    {
        Vector3 force = Vector3::Zero();
        for (const LoggedWrite &write : writes_)
            if (write.time <= time)
                force = write.wrench.force;
        return force;
    }

    /// N s; on the hand until now.
    Vector3 impulse() const
    {
        Vector3 sum = Vector3::Zero();
        for (std::size_t i = 0; i < writes_.size(); ++i)
        {
            const double until = i + 1 < writes_.size() ? writes_[i + 1].time : clock_.now();
            sum += (until - writes_[i].time) * writes_[i].wrench.force;
        }
        return sum;
    }

    bool was_quiet(double from, double to) const
    {
        if (!force_at(from).isZero(0))
            return false;
        for (const LoggedWrite &write : writes_)
            if (write.time >= from && write.time <= to && !write.wrench.force.isZero(0))
                return false;
        return true;
    }

private:
    void log(const Wrench &wrench) { writes_.push_back({clock_.now(), wrench}); }

    Device &device_;
    const LoopClock &clock_;
    std::vector<LoggedWrite> writes_;
};
} // namespace ode_predictive_space::haptics

#endif
