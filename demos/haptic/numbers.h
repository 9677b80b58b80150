#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_NUMBERS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_NUMBERS_H

#include <cstdint>
#include <string>

namespace ode_predictive_space::demo
{
/// A whole number with its digits in groups of three: 1,234,567.
std::string grouped(std::uint64_t number);

/// A number with the given number of digits after the point, grouped before it: 1,234.5.
std::string fixed(double number, int decimals);
} // namespace ode_predictive_space::demo

#endif
