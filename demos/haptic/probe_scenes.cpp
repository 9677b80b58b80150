#include "demos/haptic/probe_scenes.h"

#include "demos/haptic/room.h"
#include "demos/runs/spaces.h"

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

ProbeScene::ProbeScene(const std::string &space, const worlds::WorldFactory &factory)
    : step_seconds_(factory.tick_seconds()), space_(worlds::make_space(worlds::space_named(space), factory)),
      world_(factory.make(space_.get())), room_(worlds::room_inside_walls(*world_, factory.bounds()))
{}

void ProbeScene::respond(bool stands_still)
{
    stands_still_ = stands_still;
    if (!stands_still)
        world_->respond(pairs_.sorted()); // a loop of two threads predicts motion with these contacts
}

void ProbeScene::advance(const std::vector<dGeomID> &pushed)
{
    ++steps_;
    if (!stands_still_)
        return world_->advance();
    for (const dGeomID geom : pushed) // otherwise the next step of the world would use these forces
    {
        if (const dBodyID body = dGeomGetBody(geom); body != nullptr)
        {
            dBodySetForce(body, 0, 0, 0);
            dBodySetTorque(body, 0, 0, 0);
        }
    }
}
} // namespace ode_predictive_space::demo
