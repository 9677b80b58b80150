#include "ode_predictive_space/haptics/law/virtual_coupling.h"

#include <cmath>

#include "ode_predictive_space/haptics/device/check_argument.h"

namespace ode_predictive_space::haptics
{
namespace
{
/// The rotation as axis times angle in radians, by the shorter way round. Unlike an acos of w, exact for small angles.
Vector3 rotation_vector(const Quaternion &rotation)
{
    const double sine = rotation.vec().norm();
    if (sine == 0)
        return Vector3::Zero();
    const double angle = 2 * std::atan2(sine, std::abs(rotation.w()));
    return std::copysign(angle, rotation.w()) / sine * rotation.vec();
}
} // namespace

void check(const CouplingProperties &coupling)
{
    check_not_negative(coupling.stiffness, "stiffness of a virtual coupling");
    check_not_negative(coupling.damping, "damping of a virtual coupling");
    check_not_negative(coupling.angular_stiffness, "angular stiffness of a virtual coupling");
    check_not_negative(coupling.angular_damping, "angular damping of a virtual coupling");
}

Wrench wrench_on_device(const CouplingProperties &coupling, const ToolState &device, const ToolState &tool)
{
    return {coupling.stiffness * (tool.position - device.position) +
                coupling.damping * (tool.linear_velocity - device.linear_velocity),
            coupling.angular_stiffness * rotation_vector(tool.orientation * device.orientation.conjugate()) +
                coupling.angular_damping * (tool.angular_velocity - device.angular_velocity)};
}
} // namespace ode_predictive_space::haptics
