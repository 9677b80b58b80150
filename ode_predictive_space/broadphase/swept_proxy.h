// What the index and the sweep work on.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SWEPT_PROXY_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SWEPT_PROXY_H

#include "ode_predictive_space/broadphase/float_box.h"
#include "ode_predictive_space/broadphase/types.h"

namespace ode_predictive_space
{
/// A proxy and a box that holds it: its envelope to the end of its horizon or, while scanning, its bounds.
struct SweptProxy
{
    ProxyId proxy;
    FloatBox box;
};
} // namespace ode_predictive_space

#endif
