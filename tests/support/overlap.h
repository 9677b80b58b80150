// Whether a space must report two geoms, found without the space.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_OVERLAP_H
#define ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_OVERLAP_H

#include <ode/ode.h>

namespace ode_predictive_space
{
inline bool boxes_overlap(dGeomID one, dGeomID other)
{
    dReal a[6], b[6];
    dGeomGetAABB(one, a);
    dGeomGetAABB(other, b);
    return !(a[0] > b[1] || a[1] < b[0] || a[2] > b[3] || a[3] < b[2] || a[4] > b[5] || a[5] < b[4]);
}

/// Whether their bodies and bits allow a pair. Disabled geoms count, too.
inline bool may_collide(dGeomID one, dGeomID other)
{
    const dBodyID body = dGeomGetBody(one);
    return (body == nullptr || body != dGeomGetBody(other)) &&
           ((dGeomGetCategoryBits(one) & dGeomGetCollideBits(other)) != 0 ||
            (dGeomGetCategoryBits(other) & dGeomGetCollideBits(one)) != 0);
}
} // namespace ode_predictive_space

#endif
