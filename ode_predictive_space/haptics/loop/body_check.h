// Bodies that ODE must not step.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_BODY_CHECK_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_BODY_CHECK_H

#include <ode/common.h>
#include <string>

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
} // namespace ode_predictive_space::haptics

#endif
