// The ODE that a benchmark ran with: Debian's is built with assertions, others may not be.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_WHICH_ODE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_WHICH_ODE_H

#include <string>

namespace ode_predictive_space::benchmarks
{
/// One line: the library's file, its configuration, and whether its assertions are on.
std::string which_ode();
} // namespace ode_predictive_space::benchmarks

#endif
