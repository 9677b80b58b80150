#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_PLAIN_SWEEP_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_PLAIN_SWEEP_H

#include "tests/benchmarks/contenders/contender.h"

namespace ode_predictive_space::benchmarks
{
/// The space's own sweep, without prediction: sorts all boxes in each tick, and computes those of moved geoms.
std::unique_ptr<Contender> make_plain_sweep();
} // namespace ode_predictive_space::benchmarks

#endif
