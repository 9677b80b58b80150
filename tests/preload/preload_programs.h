#ifndef ODE_PREDICTIVE_SPACE_TESTS_PRELOAD_PRELOAD_PROGRAMS_H
#define ODE_PREDICTIVE_SPACE_TESTS_PRELOAD_PRELOAD_PROGRAMS_H

#include <cstdlib>
#include <sstream>
#include <string>

#include "tests/support/program.h"
#include "tests/support/scratch.h"

namespace ode_predictive_space::preload
{
/// AddressSanitizer requires its library to be the first in a process; ours comes before it and does no harm.
inline void allow_preload()
{
    setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 1);
}

inline Outcome launch(const std::string &arguments)
{
    allow_preload();
    return run(LAUNCHER, arguments);
}

/// The command of env(1), with the preload but without the launcher.
inline Outcome run_preloaded(const std::string &command)
{
    return run("env", "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" PRELOAD " " + command);
}
} // namespace ode_predictive_space::preload

#endif
