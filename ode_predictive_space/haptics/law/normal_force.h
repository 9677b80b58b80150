// Spring and damper of one touch, for both force laws.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NORMAL_FORCE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NORMAL_FORCE_H

#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// The force along the normal: k d with the carried depth, plus damping of the approach if `damped`. It never pulls.
/// @return N; >= 0, or not a number when an argument is not.
inline double normal_force(const ToolState &tool, const Touch &touch, const Material &material, bool damped)
{
    const double spring = material.stiffness * carry_of(touch).share;
    if (material.damping == 0 || !damped)
        return spring;
    const double force = spring + material.damping * (touch.surface_velocity - tool.linear_velocity).dot(touch.normal);
    return force < 0 ? 0 : force;
}
} // namespace ode_predictive_space::haptics

#endif
