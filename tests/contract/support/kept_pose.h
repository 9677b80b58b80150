// ODE's colliders may stop at an assertion and leave a geom displaced.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_KEPT_POSE_H
#define ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_KEPT_POSE_H

#include <ode/ode.h>

namespace ode_predictive_space
{
/// The pose of a geom when this object was made. The collider of heightfields writes another one into the geom for a while.
class KeptPose
{
public:
    explicit KeptPose(dGeomID geom);

    /// Restores the pose to the last bit, and marks the geom as moved, as its bounding box may be wrong, too.
    void restore() const;

private:
    dGeomID geom_;
    dVector3 position_ = {};
    dMatrix3 rotation_ = {};
};

/// Number of contacts of dCollide(), up to 8. It is 0 if ODE stops at an assertion (OdeMessages must exist), as it may for
/// nearly flat shapes and extreme coordinates; the geoms keep their poses.
int contacts_between(dGeomID one, dGeomID other);
} // namespace ode_predictive_space

#endif
