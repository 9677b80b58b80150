// A body of twelve capsules, joined by ball joints.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SCENES_WORLDS_RAGDOLL_H
#define ODE_PREDICTIVE_SPACE_TESTS_SCENES_WORLDS_RAGDOLL_H

#include "demos/scenes/scene_objects.h"

namespace ode_predictive_space::scenes
{
/// @param place of the feet; the ragdoll stands on them, turned by `orientation`.
void add_ragdoll(SceneObjects &objects, const Vector3 &place, const Quaternion &orientation);
} // namespace ode_predictive_space::scenes

#endif
