// An estimate of the program's step size, which ODE does not pass to a space.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_STEP_ESTIMATE_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_STEP_ESTIMATE_H

#include <array>

#include "ode_predictive_space/prediction/path.h"

namespace ode_predictive_space
{
/// The median of the last samples displacement / velocity. It ignores outliers, such as a bounce or a teleport. The value
/// before the first sample matters little: a path ends after a distance, not after a time.
class StepEstimate
{
public:
    /// The step in units of the velocities' time per tick (seconds, when velocities are per second).
    double step() const { return step_; }

    /// Adds a displacement over `ticks` > 0 ticks, unless it does not point along the mean velocity, or the velocity changed by
    /// half of its mean or more.
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
