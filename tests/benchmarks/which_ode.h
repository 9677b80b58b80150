#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_WHICH_ODE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_WHICH_ODE_H

#include <dlfcn.h>
#include <ode/ode.h>
#include <string>

namespace ode_predictive_space::benchmarks
{
/// The ODE that a benchmark runs with, in a line: the library's file, its configuration, and whether its assertions are on.
/// Debian's is built with assertions, others may not be.
inline std::string which_ode()
{
    Dl_info library{};
    const bool found = dladdr(reinterpret_cast<const void *>(&dSpaceCollide), &library) != 0;
    const bool asserts = dCheckConfiguration("ODE_EXT_no_debug") == 0;
    return std::string(found ? library.dli_fname : "an unknown file") + ": " + dGetConfiguration() +
           (asserts ? ", assertions on" : ", assertions off");
}
} // namespace ode_predictive_space::benchmarks

#endif
