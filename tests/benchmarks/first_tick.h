// What the first tick of a scene costs, with everything to be built.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_FIRST_TICK_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_FIRST_TICK_H

#include "tests/benchmarks/comparison.h"

namespace ode_predictive_space::benchmarks
{
/// Times the first dSpaceCollide() of many fresh copies of a scene, each of another seed, in each of the contenders. Their
/// pairs are compared, too; the hash of a result is that over all copies.
Comparison compare_first_ticks(const Plan &plan, int copies, Findings &findings);
} // namespace ode_predictive_space::benchmarks

#endif
