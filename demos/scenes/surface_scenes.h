// Scenes around which there is one surface: a room that is a mesh, hills that are a heightfield. Bodies fly about.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_SURFACE_SCENES_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_SURFACE_SCENES_H

#include "demos/scenes/scene.h"

namespace ode_predictive_space::scenes
{
/// The walls are rough, of 215,472 triangles.
SceneRecipe room_scene(const SceneSpec &spec);

/// At the ceiling, and at the edge of the hills, bodies turn back.
SceneRecipe hills_scene(const SceneSpec &spec);
} // namespace ode_predictive_space::scenes

#endif
