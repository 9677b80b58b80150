// The one header that includes ODE's internal classes.
//
// A new kind of dSpace must derive from dxSpace, which ODE declares only in its source package. Its members, the order of
// its virtual functions and the class numbers are the same in ODE 0.15 to 0.16.6; ode_mismatch() checks at run time
// that the library in the process agrees with what was compiled here. Compiled as a part of ODE
// (ODE_PREDICTIVE_SPACE_INSIDE_ODE), the space has a class number of its own, and nothing can disagree.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_ODE_INTERNALS_H
#define ODE_PREDICTIVE_SPACE_SPACE_ODE_INTERNALS_H

// As a part of ODE, this is compiled with -fvisibility=hidden: ODE exports every symbol that is not hidden, and neither our
// symbols nor Eigen's are for programs. The declarations of ODE keep their visibility.
#ifdef ODE_PREDICTIVE_SPACE_INSIDE_ODE
#pragma GCC visibility push(default)
#include <ode/predictive_space.h>
#else
#include "ode_predictive_space/predictive_space.h"
#endif

#include <ode/collision.h>
#include <ode/collision_space.h>
#include <ode/error.h>
#include <ode/objects.h>

#ifdef ODE_PREDICTIVE_SPACE_INSIDE_ODE
#include "config.h"
#endif

#include "odemath.h"

#include "collision_kernel.h"
#include "collision_std.h"

#ifdef ODE_PREDICTIVE_SPACE_INSIDE_ODE
#pragma GCC visibility pop
#endif

namespace ode_predictive_space
{
#ifdef ODE_PREDICTIVE_SPACE_INSIDE_ODE
constexpr int class_of_predictive_space = dPredictiveSpaceClass;
#else
// A class number for which no function of ODE has a cast.
constexpr int class_of_predictive_space = dSimpleSpaceClass;
#endif
} // namespace ode_predictive_space

#endif
