#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_H

#include "demos/runs/spaces.h"

namespace ode_predictive_space::benchmarks
{
/// A contender for this world: a space by its name, or "brute", brute force as in the paper. That one's dSpaceCollide() calls
/// dCollide(), for at most one contact, for every pair that bits and bodies allow to collide, and makes no callback.
/// Contender::finish() finds the pairs whose boxes overlap, for the comparison. Nested spaces are not supported.
/// @throws std::invalid_argument for an unknown name.
std::unique_ptr<worlds::Contender> make_contender(const std::string &name, const worlds::WorldFactory &factory);
} // namespace ode_predictive_space::benchmarks

#endif
