// The one header for ODE's internal classes: our own declarations of them, ode_layout.h, or, compiled as a part of ODE
// (ODE_PREDICTIVE_SPACE_INSIDE_ODE), ODE's own. There the space has a class number of its own, and nothing can disagree.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_ODE_INTERNALS_H
#define ODE_PREDICTIVE_SPACE_SPACE_ODE_INTERNALS_H

#ifdef ODE_PREDICTIVE_SPACE_INSIDE_ODE
// As a part of ODE, this is compiled with -fvisibility=hidden: ODE exports every symbol that is not hidden, and neither our
// symbols nor Eigen's are for programs. The declarations of ODE keep their visibility.
#pragma GCC visibility push(default)
#include <ode/predictive_space.h>

#include <ode/collision.h>
#include <ode/collision_space.h>
#include <ode/error.h>
#include <ode/objects.h>

#include "config.h"

#include "odemath.h"

#include "collision_kernel.h"
#include "collision_std.h"
#pragma GCC visibility pop
#else
#include "ode_predictive_space/predictive_space.h"
#include "ode_predictive_space/space/ode_layout.h"
#endif

namespace ode_predictive_space
{
#ifdef ODE_PREDICTIVE_SPACE_INSIDE_ODE
constexpr int class_of_predictive_space = dPredictiveSpaceClass;
#else
// The only functions of ODE with a cast for this number are dHashSpaceSetLevels() and dHashSpaceGetLevels(), which find what they
// expect (hash_levels.h): a program whose hash space is replaced may go on to call them. Colliders are the same for all spaces.
constexpr int class_of_predictive_space = dHashSpaceClass;
#endif
} // namespace ode_predictive_space

#endif
