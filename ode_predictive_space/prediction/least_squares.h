// Paths fitted to past positions, for objects whose motion is not known, such as a hand.

#ifndef ODE_PREDICTIVE_SPACE_PREDICTION_LEAST_SQUARES_H
#define ODE_PREDICTIVE_SPACE_PREDICTION_LEAST_SQUARES_H

#include "ode_predictive_space/prediction/path.h"

namespace ode_predictive_space
{
/// A position at a time in ticks.
struct Sample
{
    double time;
    Vector3 position;
};

/// The most samples that fit_path() takes.
constexpr int max_samples = 16;

/// A path whose time 0 is the time of the newest sample, and its error.
struct FittedPath
{
    Path path;
    double residual; ///< root of the mean squared distance between samples and path
};

/// Fits a path of second degree by least squares. Two samples give a line, one a still point.
///
/// @param samples in ascending order of time, the newest last; times distinct.
/// @param count 1 to max_samples.
FittedPath fit_path(const Sample *samples, int count);
} // namespace ode_predictive_space

#endif
