// The worlds, each made by the file of its name.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SCENES_WORLDS_MAKERS_H
#define ODE_PREDICTIVE_SPACE_TESTS_SCENES_WORLDS_MAKERS_H

#include "demos/scenes/surface_scenes.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::scenes
{
/// @param variation by what share of the mean the steps are longer or shorter at most.
SceneRecipe floor_world(const SceneSpec &spec, double variation);
SceneRecipe heap_world(const SceneSpec &spec, double variation);
SceneRecipe frames_world(const SceneSpec &spec, double variation);
SceneRecipe set_frames_world(const SceneSpec &spec, double variation);
SceneRecipe ragdolls_world(const SceneSpec &spec);
SceneRecipe chain_world(const SceneSpec &spec);
/// @param one_mesh ground and walls are one mesh; otherwise the ground is a plane.
SceneRecipe shelves_world(const SceneSpec &spec, bool one_mesh);
SceneRecipe drones_world(const SceneSpec &spec);
SceneRecipe city_world(const SceneSpec &spec);
SceneRecipe rain_world(const SceneSpec &spec);
SceneRecipe many_world(const SceneSpec &spec);
SceneRecipe nested_world(const SceneSpec &spec);
SceneRecipe empty_spaces_world(const SceneSpec &spec);
/// @param nested the rays of a robot have a space of their own.
SceneRecipe lidar_world(const SceneSpec &spec, bool nested);
SceneRecipe moon_world(const SceneSpec &spec);
SceneRecipe reset_world(const SceneSpec &spec);
/// @param shift by which all boxes leap at once, metres; 0 in "first".
SceneRecipe boxes_world(const SceneSpec &spec, double shift);
SceneRecipe conveyor_world(const SceneSpec &spec);
} // namespace ode_predictive_space::scenes

#endif
