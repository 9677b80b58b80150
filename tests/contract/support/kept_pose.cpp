#include "tests/contract/support/kept_pose.h"

#include <algorithm>

#include "tests/contract/support/ode_test.h"

namespace ode_predictive_space
{
namespace
{
// Heightfields may have no pose, and colliders do not move them.
bool is_moved_by_colliders(dGeomID geom)
{
    return !dGeomIsSpace(geom) && dGeomGetClass(geom) != dPlaneClass && dGeomGetClass(geom) != dHeightfieldClass;
}
} // namespace

KeptPose::KeptPose(dGeomID geom) : geom_(geom)
{
    if (!is_moved_by_colliders(geom))
        return;
    std::copy_n(dGeomGetPosition(geom), 4, position_);
    std::copy_n(dGeomGetRotation(geom), 12, rotation_);
}

void KeptPose::restore() const
{
    if (!is_moved_by_colliders(geom_))
        return;
    // dGeomSetRotation() would change a matrix that is not quite a rotation.
    std::copy_n(position_, 4, const_cast<dReal *>(dGeomGetPosition(geom_)));
    std::copy_n(rotation_, 12, const_cast<dReal *>(dGeomGetRotation(geom_)));
    if (dGeomIsOffset(geom_))
    {
        const dBodyID body = dGeomGetBody(geom_);
        const dReal *at = dBodyGetPosition(body);
        dBodySetPosition(body, at[0], at[1], at[2]);
    }
    else
        dGeomSetPosition(geom_, position_[0], position_[1], position_[2]);
}

int contacts_between(dGeomID one, dGeomID other)
{
    const KeptPose pose(one), other_pose(other);
    dContactGeom contacts[8];
    try
    {
        return dCollide(one, other, 8, contacts, sizeof contacts[0]);
    }
    catch (const OdeAbort &)
    {
        pose.restore();
        other_pose.restore();
        return 0;
    }
}
} // namespace ode_predictive_space
