// Brute force as in the paper: an exact test of every pair.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_BRUTE_FORCE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_BRUTE_FORCE_H

#include "demos/runs/contender.h"

namespace ode_predictive_space::benchmarks
{
/// dSpaceCollide() calls dCollide() for every pair whose bits and bodies let it collide, for one contact at most, and no
/// callback. The pairs whose boxes overlap are found after that, by Contender::finish(), so that they can be compared.
std::unique_ptr<worlds::Contender> make_brute_force();
} // namespace ode_predictive_space::benchmarks

#endif
