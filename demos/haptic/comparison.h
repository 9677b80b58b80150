// The scene mix in several spaces, by turns: what each of them costs.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_COMPARISON_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_COMPARISON_H

#include "demos/haptic/options.h"

namespace ode_predictive_space::demo
{
/// Compare, print, and write the results where they are wanted. ODE must be ready.
///
/// @return whether all spaces reported the same pairs.
bool compare_spaces(const Options &options);
} // namespace ode_predictive_space::demo

#endif
