#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_PROBE_SCENES_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_PROBE_SCENES_H

#include "demos/runs/contender.h"
#include "demos/worlds/world.h"

namespace ode_predictive_space::demo
{
const std::vector<std::string> &scenes_for_probes();

/// Makes the scene without the probe that it may have in other programs. @param spec its name is one of scenes_for_probes().
worlds::WorldFactory factory_for_probe(worlds::WorldSpec spec);

/// A scene with its space and its simulated time. Its pairs are those without the probe.
class ProbeScene
{
public:
    ProbeScene(const std::string &space, const worlds::WorldFactory &factory);

    dSpaceID space() const { return space_.get(); }
    const worlds::World &world() const { return *world_; }
    const Eigen::AlignedBox3d &room() const { return room_; } ///< m; inside the walls
    double step_seconds() const { return step_seconds_; }
    double time() const { return static_cast<double>(steps_) * step_seconds_; } ///< s; simulated

    worlds::PairList &pairs() { return pairs_; } ///< of the present step
    const worlds::PairList &pairs() const { return pairs_; }

    /// Makes the contacts of the pairs, unless the scene stands still in this step.
    void respond(bool stands_still);

    /// Ends the step: moves the bodies, or takes the forces of the probe from the pushed ones where the scene stands still.
    void advance(const std::vector<dGeomID> &pushed);

private:
    double step_seconds_;
    worlds::OwnedSpace space_;
    std::unique_ptr<worlds::World> world_;
    Eigen::AlignedBox3d room_;
    worlds::PairList pairs_;
    std::uint64_t steps_ = 0;
    bool stands_still_ = false;
};
} // namespace ode_predictive_space::demo

#endif
