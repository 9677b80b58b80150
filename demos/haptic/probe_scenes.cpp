#include "demos/haptic/probe_scenes.h"

#include "demos/scenes/surface_scenes.h"

namespace ode_predictive_space::demo
{
const std::vector<std::string> &scenes_for_probes()
{
    // Not the scenes with a probe or queries of their own, of kilometres, or with objects too fast to touch.
    static const std::vector<std::string> names = {"mix", "pile", "stack", "room",  "hills",
                                                   "gas", "game", "still", "churn", "explosion"};
    return names;
}

scenes::SceneFactory factory_for_probe(scenes::SceneSpec spec)
{
    spec.own_probe = false;
    if (spec.name == "room")
        return {spec, scenes::room_scene(spec)};
    if (spec.name == "hills")
        return {spec, scenes::hills_scene(spec)};
    return scenes::SceneFactory(spec);
}
} // namespace ode_predictive_space::demo
