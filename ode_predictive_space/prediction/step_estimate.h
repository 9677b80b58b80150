// The step size of the program, estimated: ODE does not tell it to a space.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_STEP_ESTIMATE_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_STEP_ESTIMATE_H

#include <array>

#include "ode_predictive_space/prediction/path.h"

namespace ode_predictive_space
{
/// The step size, estimated as the median of samples displacement / velocity.
///
/// Before the first sample it is an ordinary step: a path ends after a way, not after a time, so that an envelope depends little on it.
///
/// A bounce or a teleport gives a sample that is far off, which the median ignores. When the program changes its step size, the
/// median follows as soon as most of the remembered samples agree.
class StepEstimate
{
public:
    /// The step in units of the velocities' time per tick (seconds, when velocities are per second).
    double step() const { return step_; }

    /// Adds a sample: an object's displacement over `ticks` > 0 ticks, and its velocity at the beginning and at the end. A sample
    /// is ignored when the object hardly moved or its velocity changed by half or more.
    void add(const Vector3 &displacement, const Vector3 &velocity_before, const Vector3 &velocity_after, double ticks);

private:
    static constexpr int remembered = 9;

    std::array<double, remembered> samples_{};
    int count_ = 0;
    int next_ = 0;
    double step_ = 0.01;
};
} // namespace ode_predictive_space

#endif
