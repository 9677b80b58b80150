// Near callbacks that may throw.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SAFE_COLLIDE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SAFE_COLLIDE_H

#include <exception>

namespace ode_predictive_space::haptics
{
/// Whether safe_collide() or safe_collide2() threw this exception in this thread, so no space is locked. Valid once for each.
bool is_from_safe_collide(const std::exception_ptr &error);
} // namespace ode_predictive_space::haptics

#endif
