// What writing and reading a recording have in common.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_RECORDING_FORMAT_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_RECORDING_FORMAT_H

#include "ode_predictive_space/haptics/recording.h"

#include <cerrno>
#include <system_error>

namespace ode_predictive_space::haptics
{
/// Then: input axes, force axes, largest force, stiffness and damping, rate, least and largest corner of the workspace, and,
/// up to the end of the line, the name.
constexpr const char *device_line_mark = "# ode_predictive_space device:";

/// Then, up to the end of the line: the name of the force law.
constexpr const char *law_line_mark = "# ode_predictive_space law:";

/// Then the device's delay in s. Only where there is one.
constexpr const char *delay_line_mark = "# ode_predictive_space delay:";

/// How far from 1 the length of a quaternion may be that is recorded and read as it is.
constexpr double exact_length_tolerance = 1e-6;

/// Calls `visit` with each number of the line of a device, in order.
template <class Device, class Visit> void visit_device(Device &device, Visit visit)
{
    const auto visit_all = [&](auto &vector) {
        for (int i = 0; i < vector.size(); ++i)
            visit(vector[i]);
    };
    visit(device.input_axes);
    visit(device.force_axes);
    visit(device.max_force);
    visit(device.max_stiffness);
    visit(device.max_damping);
    visit(device.rate);
    visit_all(device.workspace.min());
    visit_all(device.workspace.max());
}

/// The same of the line of a tick.
template <class Tick, class Visit> void visit_tick(Tick &tick, Visit visit)
{
    const auto visit_all = [&](auto &vector) {
        for (int i = 0; i < vector.size(); ++i)
            visit(vector[i]);
    };
    visit(tick.state.time);
    visit_all(tick.state.position);
    visit_all(tick.state.orientation.coeffs()); // x, y, z, w
    visit_all(tick.force);
    visit(tick.state.buttons);
    visit_all(tick.state.linear_velocity);
    visit_all(tick.state.angular_velocity);
}

/// What errno says after a file could not be opened.
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
