#include "ode_predictive_space/broadphase/sweep/motion_sampler.h"

#include <algorithm>

#include "ode_predictive_space/broadphase/base/memory.h"

namespace ode_predictive_space
{
// Odd strides meet all kinds of objects where kinds alternate.
void MotionSampler::choose(const IdSet &members)
{
    const std::size_t count = members.size();
    const std::size_t wanted = std::clamp(count / 8, tuning::least_samples, tuning::most_samples);
    const std::size_t stride = std::max<std::size_t>(1, count / wanted) | 1;
    std::size_t rank = 0, next = 0;
    count_ = 0;
    looks_ = ticks_to_pause_ = 0;
    members.for_each([&](ProxyId id) {
        if (rank++ != next || count_ == tuning::most_samples)
            return;
        samples_[count_++] = {id, Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
        next += stride;
    });
}

bool MotionSampler::is_calm(Scene &scene, const IdSet &members, StepEstimate &step)
{
    if (ticks_to_pause_ > 0)
    {
        --ticks_to_pause_;
        return false;
    }
    std::size_t strayed = 0;
    for (std::size_t i = 0; i < count_; ++i)
        if (members.contains(samples_[i].id))
            strayed += !keeps_on(scene, samples_[i], step);
    const bool calm = strayed * tuning::sweeps_per_prediction <= count_;
    disturbed_looks_ = calm || looks_ < looks_for_line ? 0 : disturbed_looks_ + 1;
    looks_ = std::min(looks_ + 1, looks_for_line);
    if (disturbed_looks_ == tuning::disturbed_looks)
    {
        looks_ = 0;
        ticks_to_pause_ = tuning::pause_ticks;
    }
    return calm;
}

bool MotionSampler::keeps_on(Scene &scene, Sample &sample, StepEstimate &step) const
{
    const Box bounds = scene.bounds(sample.id);
    const bool with_bounds = false;
    Observation seen;
    scene.observe(&sample.id, 1, &with_bounds, &seen);
    // The middle of a turning object's box is carried round, its centre is not.
    const Vector3 centre = seen.centre.value_or(bounds.center()), velocity = seen.velocity.value_or(Vector3::Zero());
    const double tolerance = 0.1 * bounds.diagonal().minCoeff();
    const Vector3 expected = 2 * sample.last - sample.before;
    // False, too, when there is NaN in it.
    const bool kept = looks_ == looks_for_line && (centre - expected).cwiseAbs().maxCoeff() <= tolerance;
    if (looks_ > 0 && (centre - sample.last).allFinite())
        step.add(centre - sample.last, sample.velocity, velocity, 1);
    sample.before = sample.last;
    sample.last = centre;
    sample.velocity = velocity;
    return kept;
}
} // namespace ode_predictive_space
