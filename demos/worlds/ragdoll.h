// A body of twelve capsules, joined by ball joints.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_RAGDOLL_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_RAGDOLL_H

#include "demos/worlds/objects.h"

namespace ode_predictive_space::worlds
{
/// @param place of the feet; the ragdoll stands on them, turned by `orientation`.
void add_ragdoll(Objects &objects, const Vector3 &place, const Quaternion &orientation);
} // namespace ode_predictive_space::worlds

#endif
