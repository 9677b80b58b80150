#ifndef ODE_PREDICTIVE_SPACE_TESTS_SCENES_FEW_OBJECTS_H
#define ODE_PREDICTIVE_SPACE_TESTS_SCENES_FEW_OBJECTS_H

#include "demos/worlds/world.h"

#include <map>

namespace ode_predictive_space::worlds
{
/// So few that a test takes seconds, and enough that they meet.
inline int objects_of(const std::string &name)
{
    const std::map<std::string, int> few = {{"ragdolls", 3},     {"chain", 1}, {"city", 5},   {"nested", 6},
                                            {"nested_empty", 8}, {"many", 17}, {"lidar", 40}, {"lidar_nested", 40},
                                            {"hills", 250},      {"reset", 12}};
    const auto found = few.find(name);
    if (found != few.end())
        return found->second;
    const Group group = world_named(name).group;
    return group == Group::program ? 60 : group == Group::limit ? 50 : 100;
}
} // namespace ode_predictive_space::worlds

#endif
