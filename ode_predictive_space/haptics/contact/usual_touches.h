#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_USUAL_TOUCHES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_USUAL_TOUCHES_H

#include <cstddef>

namespace ode_predictive_space::haptics
{
/// Room for this many is made before the first tick: more than a probe usually has at a time.
constexpr std::size_t usual_touches = 64;
} // namespace ode_predictive_space::haptics

#endif
