// The scenes in which a world is stepped between two ticks.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_STEPPED_STEPPED_SCENES_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_STEPPED_STEPPED_SCENES_H

#include "demos/scenes/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
/// gas, game, classes, pile, settling, stack, terrain, teleport, dart, ask.
const std::vector<std::string> &stepped_scene_names();

/// One sentence on what happens in a scene.
///
/// @throws std::invalid_argument for a name that is not one of stepped_scene_names().
std::string describe_stepped_scene(const std::string &name);

/// What a factory for a stepped scene is to be made with: it knows where the scene takes place, and makes piles and stacks.
scenes::SceneSpec spec_of_stepped_scene(const std::string &name, int objects, std::uint64_t seed);

/// How many of its queries a scene asks in a tick, in place of dSpaceCollide(); 0 for all but ask.
std::size_t queries_of_stepped_scene(const std::string &name);

/// Where dWorldQuickStep() moves everything, with the contacts of the tick before: the cache then holds the world, not the space,
/// as in a program. Every exact space gives the same motion.
///
/// @param factory made with spec_of_stepped_scene().
std::unique_ptr<scenes::Scene> make_stepped_scene(const std::string &name, const scenes::SceneFactory &factory,
                                                  dSpaceID space);
} // namespace ode_predictive_space::benchmarks

#endif
