// Worlds as programs have them, stepped with real contacts. Every exact space gives the same motion in them.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SCENES_WORLDS_WORLDS_H
#define ODE_PREDICTIVE_SPACE_TESTS_SCENES_WORLDS_WORLDS_H

#include "demos/scenes/scene.h"

#include <string>
#include <vector>

namespace ode_predictive_space::scenes
{
/// In the order in which they are measured.
const std::vector<std::string> &world_names();

bool is_world(const std::string &name);

/// One sentence on what happens in a world, and what its number of objects counts.
///
/// @throws std::invalid_argument for a name that is not one of world_names().
std::string describe_world(const std::string &name);

/// Makes copies of a world.
///
/// @throws std::invalid_argument for a name that is not one of world_names(), or for less than one object.
SceneFactory world_factory(const SceneSpec &spec);

/// Ticks after which each of the worlds of "many" is destroyed.
constexpr int ticks_of_life = 60;

/// In "reset" and "recentre" everything moves at once in the first tick and then once in so many.
constexpr int ticks_between_events = 200;

/// Makes one of the small worlds of "many".
SceneFactory life_of_many(const SceneSpec &spec);
} // namespace ode_predictive_space::scenes

#endif
