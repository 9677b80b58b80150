#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
Vector3 sum_of(const TouchForces &forces)
{
    Vector3 sum = Vector3::Zero();
    for (const Vector3 &force : forces)
        sum += force;
    return sum;
}
} // namespace ode_predictive_space::haptics
