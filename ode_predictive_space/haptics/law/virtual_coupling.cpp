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

VirtualCoupling::VirtualCoupling(const CouplingProperties &properties) : properties_(properties)
{
    check_not_negative(properties.stiffness, "stiffness of a virtual coupling");
    check_not_negative(properties.damping, "damping of a virtual coupling");
    check_not_negative(properties.angular_stiffness, "angular stiffness of a virtual coupling");
    check_not_negative(properties.angular_damping, "angular damping of a virtual coupling");
}

Wrench VirtualCoupling::on_device(const ToolState &device, const ToolState &tool) const
{
    Wrench wrench;
    wrench.force = properties_.stiffness * (tool.position - device.position) +
                   properties_.damping * (tool.linear_velocity - device.linear_velocity);
    wrench.torque = properties_.angular_stiffness * rotation_vector(tool.orientation * device.orientation.conjugate()) +
                    properties_.angular_damping * (tool.angular_velocity - device.angular_velocity);
    return wrench;
}

void VirtualCoupling::set_stiffness(double stiffness)
{
    check_not_negative(stiffness, "stiffness of a virtual coupling");
    properties_.stiffness = stiffness;
}

Wrench opposite(const Wrench &wrench)
{
    Wrench result;
    result.force = -wrench.force;
    result.torque = -wrench.torque;
    return result;
}
} // namespace ode_predictive_space::haptics
