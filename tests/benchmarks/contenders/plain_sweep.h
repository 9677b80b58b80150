// The space's own sweep, with prediction off.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_PLAIN_SWEEP_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_PLAIN_SWEEP_H

#include "demos/runs/contender.h"

namespace ode_predictive_space::benchmarks
{
/// Sorts and sweeps the boxes of all geoms from scratch in each tick. Only the boxes of moved geoms are computed again.
std::unique_ptr<worlds::Contender> make_plain_sweep();
} // namespace ode_predictive_space::benchmarks

#endif
