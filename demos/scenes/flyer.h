// Bodies that fly freely and bounce.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_FLYER_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_FLYER_H

#include "demos/scenes/scene_objects.h"

namespace ode_predictive_space::scenes
{
/// Metres. Every other flyer is a box, the others are spheres.
struct FlyerSize
{
    Vector3 box;
    double radius = 0.1;
};

/// Without gravity and friction.
void let_fly(dWorldID world, dSurfaceParameters &surface);

/// Make a flyer that turns, and flies at up to 3 m/s in any direction.
dBodyID add_flyer(SceneObjects &objects, int number, const FlyerSize &size, const Vector3 &place,
                  haptics::Random &random);
} // namespace ode_predictive_space::scenes

#endif
