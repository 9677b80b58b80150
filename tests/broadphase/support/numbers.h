#ifndef ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_NUMBERS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_NUMBERS_H

#include <limits>

namespace ode_predictive_space
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr float float_infinity = std::numeric_limits<float>::infinity();
constexpr float largest_float = std::numeric_limits<float>::max();
} // namespace ode_predictive_space

#endif
