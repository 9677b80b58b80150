// The worlds of each file.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_LISTS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_LISTS_H

#include "demos/worlds/world.h"

namespace ode_predictive_space::worlds
{
std::vector<WorldEntry> gas_worlds();
std::vector<WorldEntry> asking_worlds();
std::vector<WorldEntry> pile_worlds();
std::vector<WorldEntry> stack_worlds();
std::vector<WorldEntry> terrain_worlds();
std::vector<WorldEntry> mix_worlds();
std::vector<WorldEntry> floor_worlds();
std::vector<WorldEntry> flying_worlds();
std::vector<WorldEntry> jointed_worlds();
std::vector<WorldEntry> robot_worlds();
std::vector<WorldEntry> free_worlds();
std::vector<WorldEntry> event_worlds();
std::vector<WorldEntry> limit_worlds();
} // namespace ode_predictive_space::worlds

#endif
