#include "demos/haptic/probe_scenes.h"

#include "demos/worlds/world.h"

namespace ode_predictive_space::demo
{
const std::vector<std::string> &scenes_for_probes()
{
    // Not the scenes with a probe or queries of their own, of kilometres, or with objects too fast to touch.
    static const std::vector<std::string> names = {"mix", "pile", "stack", "room",  "hills",
                                                   "gas", "game", "still", "churn", "explosion"};
    return names;
}

worlds::WorldFactory factory_for_probe(worlds::WorldSpec spec)
{
    spec.own_probe = false;
    return worlds::WorldFactory(spec);
}
} // namespace ode_predictive_space::demo
