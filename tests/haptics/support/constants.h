#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_CONSTANTS_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_CONSTANTS_H

#include <limits>

namespace ode_predictive_space::haptics
{
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double dt = 0.001;    // s; a tick of a loop of 1 kHz
constexpr double radius = 0.01; // m; of a probe
} // namespace ode_predictive_space::haptics

#endif
