#include "tests/benchmarks/which_ode.h"

#include <dlfcn.h>
#include <ode/ode.h>

namespace ode_predictive_space::benchmarks
{
std::string which_ode()
{
    Dl_info library{};
    const bool found = dladdr(reinterpret_cast<const void *>(&dSpaceCollide), &library) != 0;
    const bool asserts = dCheckConfiguration("ODE_EXT_no_debug") == 0;
    return std::string(found ? library.dli_fname : "an unknown file") + ": " + dGetConfiguration() +
           (asserts ? ", assertions on" : ", assertions off");
}
} // namespace ode_predictive_space::benchmarks
