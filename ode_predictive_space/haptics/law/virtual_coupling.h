// A spring between the hand and a body of the scene.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_VIRTUAL_COUPLING_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_VIRTUAL_COUPLING_H

#include "ode_predictive_space/haptics/device/check_argument.h"
#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// @throws std::invalid_argument when a property is negative or not finite.
inline void check(const CouplingProperties &coupling)
{
    check_not_negative(coupling.stiffness, "stiffness of a virtual coupling");
    check_not_negative(coupling.damping, "damping of a virtual coupling");
    check_not_negative(coupling.angular_stiffness, "angular stiffness of a virtual coupling");
    check_not_negative(coupling.angular_damping, "angular damping of a virtual coupling");
}

/// Holds a dynamic body (the tool) to the device by a spring and a damper, for position and for orientation
/// (Colgate, Stanley and Brown, "Issues in the haptic display of tool use", 1995). The body collides as any other; the hand feels
/// only the coupling, which therefore bounds what stiffness the device has to render, whatever the tool hits.
///
/// @param device the device's handle, @param tool the body that is held; both in the scene's frame.
/// The orientations are joined by the shorter way round.
/// @return the wrench on the device; the tool body gets exactly the opposite, force and torque, at its position.
inline Wrench wrench_on_device(const CouplingProperties &coupling, const ToolState &device, const ToolState &tool)
{
    const Eigen::AngleAxisd turn(tool.orientation * device.orientation.conjugate()); // the shorter way
    return {coupling.stiffness * (tool.position - device.position) +
                coupling.damping * (tool.linear_velocity - device.linear_velocity),
            coupling.angular_stiffness * turn.angle() * turn.axis() +
                coupling.angular_damping * (tool.angular_velocity - device.angular_velocity)};
}
} // namespace ode_predictive_space::haptics

#endif
