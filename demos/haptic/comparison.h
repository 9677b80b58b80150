#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_COMPARISON_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_COMPARISON_H

#include "demos/haptic/options.h"

namespace ode_predictive_space::demo
{
/// Prints and writes the costs of spaces, alternating. ODE must be initialised. @return whether all reported the same pairs.
bool compare_spaces(const Options &options);
} // namespace ode_predictive_space::demo

#endif
