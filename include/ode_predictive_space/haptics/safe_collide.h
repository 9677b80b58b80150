// Near callbacks that may throw.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SAFE_COLLIDE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SAFE_COLLIDE_H

#include <exception>
#include <ode/collision.h>
#include <ode/collision_space.h>

namespace ode_predictive_space::haptics
{
/// dSpaceCollide() and dSpaceCollide2(), with a callback that may throw. ODE's own spaces stay locked for ever when an exception
/// goes through them; these two keep it until ODE is done, without further calls of the callback, and throw it then.
void safe_collide(dSpaceID space, void *data, dNearCallback *callback);
/// See safe_collide().
void safe_collide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback);

/// For loops: whether one of the two threw this in this thread, so that no space is locked by it. Once for each exception.
bool is_from_safe_collide(const std::exception_ptr &error);
} // namespace ode_predictive_space::haptics

#endif
