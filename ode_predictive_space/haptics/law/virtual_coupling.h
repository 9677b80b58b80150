// A spring between the hand and a body of the scene.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_VIRTUAL_COUPLING_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_VIRTUAL_COUPLING_H

#include "ode_predictive_space/haptics/device/check_argument.h"
#include "ode_predictive_space/haptics/force_law.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
inline void check(const CouplingProperties &coupling)
{
    check_not_negative(coupling.stiffness, "stiffness of a virtual coupling");
    check_not_negative(coupling.damping, "damping of a virtual coupling");
    check_not_negative(coupling.angular_stiffness, "angular stiffness of a virtual coupling");
    check_not_negative(coupling.angular_damping, "angular damping of a virtual coupling");
}

/// Holds a dynamic body (the tool) to the device by a spring and a damper, in position and orientation (Colgate, Stanley and
/// Brown, "Issues in the haptic display of tool use", 1995). The hand feels only the coupling, which bounds the stiffness that
/// the device has to render. Both states are in the scene's frame; orientations are joined by the shorter rotation.
/// @return the wrench on the device; the tool body gets exactly the opposite, force and torque, at its position.
inline Wrench wrench_on_device(const CouplingProperties &coupling, const ToolState &device, const ToolState &tool)
{
    const Eigen::AngleAxisd turn(tool.orientation * device.orientation.conjugate()); // the shorter way
    return {coupling.stiffness * (tool.position - device.position) +
                coupling.damping * (tool.linear_velocity - device.linear_velocity),
            coupling.angular_stiffness * turn.angle() * turn.axis() +
                coupling.angular_damping * (tool.angular_velocity - device.angular_velocity)};
}

/// A body is stepped with the force of the tick before, so a spring k and a damper b on a mass m diverge from h^2 k + 2 h b = 4
/// m on. These bounds allow half of that, and leave the rest to contacts of the tool. Rotations use the smallest inertia.
/// @param mass kg, @param inertia kg m^2; of the tool's body. @param dt s, > 0.
/// @return the coupling, with no more stiffness and damping than the body can be stepped with.
inline CouplingProperties bounded(const CouplingProperties &coupling, double mass, double inertia, double dt)
{
    CouplingProperties result;
    result.stiffness = std::min(coupling.stiffness, mass / (dt * dt));
    result.damping = std::min(coupling.damping, mass / (2 * dt));
    result.angular_stiffness = std::min(coupling.angular_stiffness, inertia / (dt * dt));
    result.angular_damping = std::min(coupling.angular_damping, inertia / (2 * dt));
    return result;
}
} // namespace ode_predictive_space::haptics

#endif
