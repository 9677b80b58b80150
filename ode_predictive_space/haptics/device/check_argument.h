// Validation of numbers.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CHECK_ARGUMENT_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CHECK_ARGUMENT_H

#include <cmath>
#include <stdexcept>
#include <string>

namespace ode_predictive_space::haptics
{
/// @throws std::invalid_argument "<what> must be <range>, not <value>".
[[noreturn]] inline void refuse(double value, const char *what, const char *range)
{
    throw std::invalid_argument(std::string(what) + " must be " + range + ", not " + std::to_string(value));
}

inline bool is_amount(double value)
{
    return std::isfinite(value) && value >= 0;
}

inline void check_not_negative(double value, const char *what)
{
    if (!is_amount(value))
        refuse(value, what, "finite and not negative");
}

inline void check_positive(double value, const char *what)
{
    if (!std::isfinite(value) || value <= 0)
        refuse(value, what, "finite and above zero");
}
} // namespace ode_predictive_space::haptics

#endif
