#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_HAPTIC_SCENE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_HAPTIC_SCENE_H

#include "demos/worlds/world.h"
#include "ode_predictive_space/haptics/loop/time_histogram.h"
#include "ode_predictive_space/haptics/probe.h"
#include "ode_predictive_space/recording/bounded_series.h"

namespace ode_predictive_space::demo
{
struct SceneTotals
{
    haptics::TimeSummary collide;              ///< s; in dSpaceCollide()
    recording::BoundedSeries collide_series{}; ///< s; the same, in each step
    recording::BoundedSeries advance_series{}; ///< s; in the step of the world
    std::uint64_t pairs = 0;                   ///< reported by the space, summed over the steps
};

/// The world around a probe, in a space: finds the pairs, steps, and measures both.
class HapticScene
{
public:
    /// @param space a name that worlds::make_space() knows. @param factory makes the world without a probe.
    HapticScene(const std::string &space, const worlds::WorldFactory &factory);

    /// The first half of a step: dSpaceCollide(), and contacts between the objects. The probe's pairs touch it.
    /// @param paused the objects stand still in this step.
    void collide(haptics::HapticProbe &probe, bool paused);

    /// The second half, when the forces of the probe act on the bodies. @return seconds that it took.
    double advance();

    dSpaceID space() const { return space_.get(); }
    const worlds::World &world() const { return *world_; }
    const Eigen::AlignedBox3d &room() const { return room_; }        ///< m; inside the walls
    double step_seconds() const { return step_seconds_; }            ///< simulated
    double time() const { return step_seconds_ * steps_; }           ///< s; simulated
    const worlds::PairList &pairs() const { return pairs_; }         ///< of the last step, without the probe's
    const std::vector<dGeomID> &near_probe() const { return near_; } ///< in the last step
    SceneTotals totals() const;

private:
    void undo_pushes();

    worlds::OwnedSpace space_;
    std::unique_ptr<worlds::World> world_;
    Eigen::AlignedBox3d room_;
    double step_seconds_;
    int steps_ = 0;
    bool paused_ = false; ///< in the present step
    worlds::PairList pairs_;
    std::vector<dGeomID> near_;
    haptics::TimeHistogram collide_times_;
    SceneTotals totals_; ///< without the summary
    haptics::MonotonicClock clock_;
};
} // namespace ode_predictive_space::demo

#endif
