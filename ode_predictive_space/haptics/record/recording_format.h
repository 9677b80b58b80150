// The format of recordings, for writing and reading; docs/haptics/guide.md describes the lines.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_RECORDING_FORMAT_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_RECORDING_FORMAT_H

#include "ode_predictive_space/haptics/recording.h"

#include <cerrno>
#include <system_error>

namespace ode_predictive_space::haptics
{
constexpr const char *device_line_mark = "# ode_predictive_space device:";
constexpr const char *law_line_mark = "# ode_predictive_space law:";

/// Followed by the device's delay in s, if any.
constexpr const char *delay_line_mark = "# ode_predictive_space delay:";

/// Tolerance of the length of a quaternion that is recorded and read unchanged.
constexpr double exact_length_tolerance = 1e-6;

template <class Vector, class Visit> void visit_each(Vector &vector, Visit &visit)
{
    for (int i = 0; i < vector.size(); ++i)
        visit(vector[i]);
}

/// Calls `visit` with each number of a device's line, in order; the name follows.
template <class Device, class Visit> void visit_device(Device &device, Visit visit)
{
    visit(device.input_axes);
    visit(device.force_axes);
    visit(device.max_force);
    visit(device.max_stiffness);
    visit(device.max_damping);
    visit(device.rate);
    visit_each(device.workspace.min(), visit);
    visit_each(device.workspace.max(), visit);
}

template <class Tick, class Visit> void visit_tick(Tick &tick, Visit visit)
{
    visit(tick.state.time);
    visit_each(tick.state.position, visit);
    visit_each(tick.state.orientation.coeffs(), visit); // x, y, z, w
    visit_each(tick.force, visit);
    visit(tick.state.buttons);
    visit_each(tick.state.linear_velocity, visit);
    visit_each(tick.state.angular_velocity, visit);
}

/// The error of a file that could not be opened, from errno.
inline DeviceError file_error(const std::string &file, int error)
{
    DeviceFault fault = DeviceFault::bad_file;
    if (error == ENOENT || error == ENOTDIR)
        fault = DeviceFault::missing_file;
    else if (error == EACCES || error == EPERM || error == EROFS)
        fault = DeviceFault::permission_denied;
    return DeviceError(fault, "recording " + file + ": " + std::generic_category().message(error));
}
} // namespace ode_predictive_space::haptics

#endif
