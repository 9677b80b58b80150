// Paths fitted to past positions, for objects whose motion is not known, such as a hand.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_LEAST_SQUARES_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_LEAST_SQUARES_H

#include "ode_predictive_space/prediction/path.h"

namespace ode_predictive_space
{
struct Sample
{
    double time; ///< in ticks
    Vector3 position;
};

constexpr int max_samples = 16; ///< for fit_path()

struct FittedPath
{
    Path path;
    double residual; ///< root mean square distance between samples and path
};

/// A path of second degree, with time 0 at the newest sample. Two samples give a line, one sample a constant position.
/// @param samples in ascending order of time, with distinct times. @param count 1 to max_samples.
FittedPath fit_path(const Sample *samples, int count);
} // namespace ode_predictive_space

#endif
