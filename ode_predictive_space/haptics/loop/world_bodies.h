// All bodies of a world.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_WORLD_BODIES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_WORLD_BODIES_H

#include <ode/ode.h>
#include <vector>

namespace ode_predictive_space::haptics
{
/// Also those without geoms and joints, which ODE has no function to find. Not while the world steps.
///
/// @throws std::runtime_error when the ODE in this process keeps its bodies in another way than 0.15 to 0.16.6.
std::vector<dBodyID> bodies_of(dWorldID world);
} // namespace ode_predictive_space::haptics

#endif
