#ifndef ODE_PREDICTIVE_SPACE_RECORDING_FORMATTED_H
#define ODE_PREDICTIVE_SPACE_RECORDING_FORMATTED_H

#include <cstdio>
#include <string>

namespace ode_predictive_space::recording
{
/// As std::printf() would print it; at most 699 bytes of it.
template <typename... Arguments> std::string formatted(const char *format, Arguments... arguments)
{
    char text[700];
    std::snprintf(text, sizeof text, format, arguments...);
    return text;
}
inline std::string readable(double value)
{
    return formatted(value < 1000 ? "%.3g" : "%.0f", value);
}
} // namespace ode_predictive_space::recording

#endif
