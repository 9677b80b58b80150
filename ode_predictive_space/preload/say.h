#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_SAY_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_SAY_H

#include <cstdarg>
#include <cstdio>

namespace ode_predictive_space::preload
{
/// One line on standard error, in one piece, so that the lines of several processes do not mix.
__attribute__((format(printf, 1, 2))) inline void say(const char *format, ...)
{
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    std::fprintf(stderr, "ode_predictive_space: %s\n", line);
}
} // namespace ode_predictive_space::preload

#endif
