// Compares the cost of several spaces, alternating, in the scene mix.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_COMPARISON_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_COMPARISON_H

#include "demos/haptic/options.h"

namespace ode_predictive_space::demo
{
/// Compare, print, and write the results to the requested file. ODE must be initialised.
///
/// @return whether all spaces reported the same pairs.
bool compare_spaces(const Options &options);
} // namespace ode_predictive_space::demo

#endif
