#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_SAY_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_SAY_H

#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "ode_predictive_space/recording/printable.h"

namespace ode_predictive_space::preload
{
/// Writes one line to standard error, printable and in one piece, so that the lines of several processes do not mix.
__attribute__((format(printf, 1, 2))) inline void say(const char *format, ...)
{
    char line[1024], shown[4 * sizeof line];
    std::size_t size = 0;
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    put_printable(line, line + std::strlen(line), [&](char each) { shown[size++] = each; });
    std::fprintf(stderr, "ode_predictive_space: %.*s\n", static_cast<int>(size), shown);
}
} // namespace ode_predictive_space::preload

#endif
