#include "ode_predictive_space/haptics/law/virtual_coupling.h"

#include "ode_predictive_space/haptics/device/check_argument.h"

namespace ode_predictive_space::haptics
{
void check(const CouplingProperties &coupling)
{
    check_not_negative(coupling.stiffness, "stiffness of a virtual coupling");
    check_not_negative(coupling.damping, "damping of a virtual coupling");
    check_not_negative(coupling.angular_stiffness, "angular stiffness of a virtual coupling");
    check_not_negative(coupling.angular_damping, "angular damping of a virtual coupling");
}

Wrench wrench_on_device(const CouplingProperties &coupling, const ToolState &device, const ToolState &tool)
{
    const Eigen::AngleAxisd turn(tool.orientation * device.orientation.conjugate()); // the shorter way
    return {coupling.stiffness * (tool.position - device.position) +
                coupling.damping * (tool.linear_velocity - device.linear_velocity),
            coupling.angular_stiffness * turn.angle() * turn.axis() +
                coupling.angular_damping * (tool.angular_velocity - device.angular_velocity)};
}
} // namespace ode_predictive_space::haptics
