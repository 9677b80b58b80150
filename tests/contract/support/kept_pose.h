// ODE's colliders may stop at an assertion and leave a geom where they had moved it.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_KEPT_POSE_H
#define ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_KEPT_POSE_H

#include <ode/ode.h>

namespace ode_predictive_space
{
/// The pose that a geom had when this object was made. The collider of heightfields writes another one into the geom for a while.
class KeptPose
{
public:
    explicit KeptPose(dGeomID geom);

    /// Gives the geom its pose back, to the last bit, and says to ODE that it moved: its bounding box may be wrong, too.
    void restore() const;

private:
    dGeomID geom_;
    dVector3 position_ = {};
    dMatrix3 rotation_ = {};
};

/// How many contacts dCollide() finds, up to 8. None when it stops at an assertion (OdeMessages must live), as it may with forms
/// that are all but flat and where coordinates are extreme; the geoms keep their poses.
int contacts_between(dGeomID one, dGeomID other);
} // namespace ode_predictive_space

#endif
