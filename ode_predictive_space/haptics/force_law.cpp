#include "ode_predictive_space/haptics/force_law.h"

#include "ode_predictive_space/haptics/check_argument.h"

namespace ode_predictive_space::haptics
{
Vector3 sum_of(const TouchForces &forces)
{
    Vector3 sum = Vector3::Zero();
    for (const Vector3 &force : forces)
        sum += force;
    return sum;
}

void check(const SurfaceProperties &properties)
{
    check_not_negative(properties.stiffness, "stiffness of a surface");
    check_not_negative(properties.damping, "damping of a surface");
    check_not_negative(properties.friction, "friction of a surface");
}
} // namespace ode_predictive_space::haptics
