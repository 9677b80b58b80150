#include "demos/haptic/haptic_scene.h"

#include "demos/haptic/room.h"
#include "demos/worlds/spaces.h"

namespace ode_predictive_space::demo
{
HapticScene::HapticScene(const std::string &space, const worlds::WorldFactory &factory)
    : space_(worlds::make_space(space, factory)), world_(factory.make(space_.get())),
      room_(worlds::room_inside_walls(*world_, factory.bounds())), step_seconds_(factory.tick_seconds())
{}

void HapticScene::collide(haptics::HapticProbe &probe, bool paused)
{
    struct Report
    {
        HapticScene &scene;
        haptics::HapticProbe &probe;
    } report{*this, probe};
    const auto near = [](void *data, dGeomID first, dGeomID second) {
        auto &[scene, touched] = *static_cast<Report *>(data);
        if (touched.touch(first, second))
            scene.near_.push_back(first == touched.geom() ? second : first);
        else
            worlds::PairList::collect(&scene.pairs_, first, second);
    };
    paused_ = paused;
    pairs_.clear();
    near_.clear();
    const double begin = clock_.now();
    dSpaceCollide(space(), &report, near);
    const double seconds = clock_.now() - begin;
    collide_times_.add(seconds);
    totals_.collide_series.add(seconds);
    totals_.pairs += pairs_.size() + near_.size();
    if (!paused_)
        world_->respond(pairs_.sorted()); // a loop of two threads predicts motion with these contacts
}

double HapticScene::advance()
{
    const double begin = clock_.now();
    ++steps_;
    if (paused_)
        undo_pushes();
    else
        world_->advance();
    const double seconds = clock_.now() - begin;
    totals_.advance_series.add(seconds);
    return seconds;
}

SceneTotals HapticScene::totals() const
{
    SceneTotals totals = totals_;
    totals.collide = collide_times_.summary();
    return totals;
}

/// Takes the forces of the probe from the bodies near it. Otherwise the next step of the world would use these forces.
void HapticScene::undo_pushes()
{
    for (const dGeomID geom : near_)
    {
        if (const dBodyID body = dGeomGetBody(geom); body != nullptr)
        {
            dBodySetForce(body, 0, 0, 0);
            dBodySetTorque(body, 0, 0, 0);
        }
    }
}
} // namespace ode_predictive_space::demo
