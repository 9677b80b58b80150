// A run in windows of time.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_WINDOWS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_WINDOWS_H

#include "tests/benchmarks/comparison.h"

#include <vector>

namespace ode_predictive_space::benchmarks
{
/// The measured ticks of a comparison in windows of so many ticks, the last one perhaps shorter. Only the times are divided: pairs,
/// contacts and hash are those of the whole run in each window.
std::vector<Comparison> windows_of(const Comparison &whole, std::size_t ticks_per_window);
} // namespace ode_predictive_space::benchmarks

#endif
