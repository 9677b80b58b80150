#include "ode_predictive_space/haptics/device.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
const char *name_of(DeviceFault fault)
{
    static constexpr const char *names[] = {
        "missing_library", "missing_symbol", "missing_file", "bad_file", "permission_denied",
        "not_found",       "not_calibrated", "lost",         "failed",   "not_open"};
    return names[static_cast<int>(fault)];
}

SoftwareDevice::SoftwareDevice(const std::string &name, int input_axes, const Eigen::AlignedBox3d &workspace)
{
    capabilities_.name = name;
    capabilities_.input_axes = input_axes;
    capabilities_.force_axes = 0;
    capabilities_.workspace = workspace;
}

void SoftwareDevice::open()
{
    if (!open_)
    {
        start();
        first_time_.reset();
        last_seconds_ = 0;
        open_ = true;
    }
}

void SoftwareDevice::close() noexcept
{
    open_ = false;
    last_wrench_ = Wrench();
}

DeviceState SoftwareDevice::read(double time)
{
    check_open("read");
    if (!std::isfinite(time))
        throw std::invalid_argument(capabilities_.name + ": the time of a read() is not finite");
    if (!first_time_)
        first_time_ = time;
    last_seconds_ = std::max(last_seconds_, time - *first_time_);
    DeviceState state = move_to(last_seconds_);
    state.time = time;
    return state;
}

void SoftwareDevice::write(const Wrench &wrench)
{
    check_open("write");
    if (!wrench.force.allFinite() || !wrench.torque.allFinite())
    {
        last_wrench_ = Wrench();
        throw DeviceError(DeviceFault::failed, capabilities_.name + ": a force that is not finite was written");
    }
    last_wrench_ = wrench;
}

DeviceStatus SoftwareDevice::status() const
{
    if (!open_)
        return {false, false, capabilities_.name + ": not open"};
    const std::string reason = idle_reason();
    return {true, reason.empty(), reason};
}

void SoftwareDevice::check_open(const char *call) const
{
    if (!open_)
        throw DeviceError(DeviceFault::not_open, capabilities_.name + ": " + call + "() before open()");
}
} // namespace ode_predictive_space::haptics
