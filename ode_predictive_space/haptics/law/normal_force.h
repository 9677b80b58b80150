// Spring and damper of one touch, as both force laws have them.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NORMAL_FORCE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NORMAL_FORCE_H

#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// The force along a normal: k d, and the damping of the approach if the touch is damped. It never pulls.
///
/// @param normal of length 1, out of the surface.
/// @param depth m; how deep the spring is pressed.
/// @return N; >= 0, or not a number when an argument is not.
inline double normal_force(const ToolState &tool, const Touch &touch, const Material &material, const Vector3 &normal,
                           double depth, bool damped)
{
    const double spring = material.stiffness * depth;
    if (material.damping == 0 || !damped)
        return spring;
    const double force = spring + material.damping * (touch.surface_velocity - tool.linear_velocity).dot(normal);
    return force < 0 ? 0 : force;
}
} // namespace ode_predictive_space::haptics

#endif
