// The bodies of a scene: all of a world, and those that ODE must not step.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_BODIES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_BODIES_H

#include <ode/common.h>
#include <string>
#include <vector>

namespace ode_predictive_space::haptics
{
/// What of a body's state is not finite, its force and torque included: dWorldStep() and dSpaceCollide() end the program for it by
/// an assertion, or spread it to other bodies.
///
/// @param body may be 0.
/// @return a sentence that names the body; empty when all is finite.
std::string broken_state_of(dBodyID body);

/// The same of the first such body in a scene: of all bodies with a geom in the spaces that this geom is in, and in those within.
///
/// @param geom may be 0.
std::string broken_state_around(dGeomID geom);

/// All bodies of a world, also those without geoms and joints, which ODE has no function to find. Not while the world steps.
///
/// @throws std::runtime_error when the ODE in this process keeps its bodies in another way than 0.15 to 0.16.6.
std::vector<dBodyID> bodies_of(dWorldID world);
} // namespace ode_predictive_space::haptics

#endif
