#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_NUMBERS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_NUMBERS_H

#include <cstdint>
#include <string>

namespace ode_predictive_space::demo
{
/// A number with the given number of digits after the point, in groups of three before it: 1,234.5.
std::string fixed(double number, int decimals);

inline std::string grouped(std::uint64_t number)
{
    return fixed(static_cast<double>(number), 0);
}
} // namespace ode_predictive_space::demo

#endif
