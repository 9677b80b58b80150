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

inline int count_of(const std::string &part, const std::string &text)
{
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}
} // namespace ode_predictive_space::preload

#endif
