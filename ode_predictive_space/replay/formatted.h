#ifndef ODE_PREDICTIVE_SPACE_REPLAY_FORMATTED_H
#define ODE_PREDICTIVE_SPACE_REPLAY_FORMATTED_H

#include <cstdio>
#include <string>

namespace ode_predictive_space::replay
{
/// As std::printf() would print it; at most 699 bytes of it.
template <typename... Arguments> std::string formatted(const char *format, Arguments... arguments)
{
    char text[700];
    std::snprintf(text, sizeof text, format, arguments...);
    return text;
}
} // namespace ode_predictive_space::replay

#endif
