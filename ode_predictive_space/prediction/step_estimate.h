// How many ticks' worth of motion a unit of a body's velocity is: ODE hands a space no step size.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_STEP_ESTIMATE_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_STEP_ESTIMATE_H

#include <array>

#include "ode_predictive_space/prediction/path.h"

namespace ode_predictive_space
{
/// The step size, estimated from displacements that were seen: the median of the last samples.
///
/// A bounce or a teleport gives a sample that is far off. The median does not follow single ones, and when the program
/// changes its step size, it follows as soon as most of the remembered samples agree.
class StepEstimate
{
public:
    /// The step in ticks' units (seconds per tick, when velocities are per second); 0 while nothing is known.
    double step() const { return step_; }

    /// Takes an object's displacement over `ticks` > 0 ticks and its velocity at the beginning and at the end. Objects that
    /// hardly moved, or whose velocity changed by much, say nothing and are passed over.
    void add(const Vector3 &displacement, const Vector3 &velocity_before, const Vector3 &velocity_after, double ticks);

private:
    static constexpr int remembered = 9;

    std::array<double, remembered> samples_{};
    int count_ = 0;
    int next_ = 0;
    double step_ = 0;
};
} // namespace ode_predictive_space

#endif
