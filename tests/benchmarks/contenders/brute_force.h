#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_BRUTE_FORCE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_BRUTE_FORCE_H

#include "tests/benchmarks/contenders/contender.h"

namespace ode_predictive_space::benchmarks
{
/// Brute force as in the paper: dSpaceCollide() calls dCollide(), for at most one contact, for every pair that bits and bodies
/// allow to collide, and makes no callback. Contender::finish() finds the pairs whose boxes overlap, for the comparison.
std::unique_ptr<Contender> make_brute_force();
} // namespace ode_predictive_space::benchmarks

#endif
