// ODE's internal classes: those of layout.h or, inside ODE (ODE_PREDICTIVE_SPACE_INSIDE_ODE), ODE's own headers.

#ifndef ODE_PREDICTIVE_SPACE_ODE_INTERNALS_H
#define ODE_PREDICTIVE_SPACE_ODE_INTERNALS_H

#ifdef ODE_PREDICTIVE_SPACE_INSIDE_ODE
// Inside ODE, the space is compiled with -fvisibility=hidden, because ODE exports every visible symbol, also ours and Eigen's.
// ODE's declarations keep their visibility.
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
#include "ode_predictive_space/ode/layout.h"
#include "ode_predictive_space/predictive_space.h"
#endif

namespace ode_predictive_space
{
#ifdef ODE_PREDICTIVE_SPACE_INSIDE_ODE
constexpr int class_of_predictive_space = dPredictiveSpaceClass;
#else
// Only dHashSpaceSetLevels() and dHashSpaceGetLevels() cast by this number in ODE, and dxPredictiveSpace has what they expect: a
// program whose hash space is replaced may still call them. Colliders are the same for all spaces.
constexpr int class_of_predictive_space = dHashSpaceClass;
#endif
} // namespace ode_predictive_space

#endif
