// The one header that includes ODE's internal classes.
//
// A dSpace of one's own must derive from dxSpace, which ODE declares only in its source package. Its members, the order of
// its virtual functions and the class numbers are the same in ODE 0.13 to 0.16.6; ode_matches_headers() checks at run time
// that the library in the process agrees with what was compiled here.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_ODE_INTERNALS_H
#define ODE_PREDICTIVE_SPACE_SPACE_ODE_INTERNALS_H

#include <ode/common.h>

#include <ode/collision.h>
#include <ode/collision_space.h>
#include <ode/error.h>
#include <ode/objects.h>

#include "odemath.h"

#include "collision_kernel.h"
#include "collision_std.h"

#endif
