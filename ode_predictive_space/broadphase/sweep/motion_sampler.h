// A few objects that are watched while the scene is swept: do they move as could be predicted?

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_MOTION_SAMPLER_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_MOTION_SAMPLER_H

#include <array>

#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/objects/scene.h"
#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/prediction/step_estimate.h"

namespace ode_predictive_space
{
/// Tells whether each sampled object is where its last two positions lead. Learns meanwhile how far a body's velocity carries
/// it in a tick.
class MotionSampler
{
public:
    /// Chooses samples among the members, evenly by number, the same ones for the same members. Throws nothing.
    void choose(const IdSet &members);

    /// Looks where the samples are now, a tick after the last call. After several disturbed looks in a row it pauses for some
    /// calls, which return false.
    ///
    /// @return true when so many moved as predicted that predicting all would pay.
    bool is_calm(Scene &scene, const IdSet &members, StepEstimate &step);

private:
    static constexpr int looks_for_line = 2; // after so many it is known where objects in uniform motion will be

    struct Sample
    {
        ProxyId id;
        Vector3 before;
        Vector3 last;
        Vector3 velocity; // when last seen
    };

    bool keeps_on(Scene &scene, Sample &sample, StepEstimate &step) const;

    std::array<Sample, tuning::most_samples> samples_;
    std::size_t count_ = 0;   // of samples_
    int looks_ = 0;           // in a row, up to looks_for_line
    int disturbed_looks_ = 0; // in a row
    int ticks_to_pause_ = 0;
};
} // namespace ode_predictive_space

#endif
