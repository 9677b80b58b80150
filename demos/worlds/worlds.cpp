#include "demos/worlds/lists.h"

#include <algorithm>
#include <stdexcept>

namespace ode_predictive_space::worlds
{
void World::collide(dSpaceID space, void *data, const NearCallbacks &near)
{
    dSpaceCollide(space, data, near.geoms);
}

const std::vector<dGeomID> &World::queries() const
{
    static const std::vector<dGeomID> none;
    return none;
}

const std::vector<WorldEntry> &all_worlds()
{
    static const std::vector<WorldEntry> all = [] {
        std::vector<WorldEntry> result;
        for (const auto list :
             {&gas_worlds, &asking_worlds, &pile_worlds, &stack_worlds, &terrain_worlds, &mix_worlds, &floor_worlds,
              &jointed_worlds, &robot_worlds, &flying_worlds, &free_worlds, &event_worlds, &limit_worlds})
        {
            for (const WorldEntry &entry : list())
                result.push_back(entry);
        }
        return result;
    }();
    return all;
}

const WorldEntry &world_named(const std::string &name)
{
    const auto found = std::find_if(all_worlds().begin(), all_worlds().end(),
                                    [&](const WorldEntry &entry) { return entry.name == name; });
    if (found == all_worlds().end())
        throw std::invalid_argument("there is no world named \"" + name + "\"");
    return *found;
}

std::vector<std::string> world_names(Group group)
{
    std::vector<std::string> names;
    for (const WorldEntry &entry : all_worlds())
    {
        if (entry.group == group)
            names.push_back(entry.name);
    }
    return names;
}

WorldFactory::WorldFactory(const WorldSpec &spec) : spec_(spec), entry_(world_named(spec.name))
{
    if (spec.objects < 1)
        throw std::invalid_argument("a world needs at least one object");
    make_ = entry_.prepare(spec);
}
} // namespace ode_predictive_space::worlds
