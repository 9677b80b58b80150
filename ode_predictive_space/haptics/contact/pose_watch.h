// How the geoms around the probe move, also those that the program poses without a velocity.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_POSE_WATCH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_POSE_WATCH_H

#include "ode_predictive_space/haptics/device.h"

#include <cstdint>
#include <ode/common.h>
#include <vector>

namespace ode_predictive_space::haptics
{
/// Where something rigid is in the scene.
struct Pose
{
    Vector3 position = Vector3::Zero(); ///< m
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

/// Of any geom, also of one that cannot be placed.
Pose pose_of(dGeomID geom);

/// How something rigid moves.
struct Motion
{
    Vector3 centre = Vector3::Zero();  ///< m
    Vector3 linear = Vector3::Zero();  ///< m/s; of the centre
    Vector3 angular = Vector3::Zero(); ///< rad/s

    /// m/s.
    Vector3 velocity_at(const Vector3 &point) const { return linear + angular.cross(point - centre); }
};

/// By the velocity of the geom's body; none without a body.
Motion body_motion_of(dGeomID geom, const Pose &pose);

/// Tracked objects, lifts and doors are often posed at each tick, and no body has their velocity. Their poses show it.
///
/// Each tick: begin(), then motion_of() for each geom that the near callback reports.
class PoseWatch
{
public:
    /// m/s; of poses. What is posed farther away in a tick was put there. A tenth more than the 2 m/s that are promised, since ticks
    /// vary.
    static constexpr double fastest = 2.2;

    PoseWatch();

    /// What was not reported in the tick before is new.
    void begin();

    /// By the body, or by the poses if these are faster than the body is now and was a tick ago.
    ///
    /// @param where m; the point whose velocities are compared.
    /// @param tick s; since the tick before; 0 if that is not known.
    Motion motion_of(dGeomID geom, const Pose &pose, const Vector3 &where, double tick);

private:
    struct Seen
    {
        dGeomID geom;
        std::uintptr_t object; ///< Touch::object
        Pose pose;
        Motion by_body;
    };

    const Seen *seen_before(dGeomID geom, std::uintptr_t object);

    std::vector<Seen> now_;
    std::vector<Seen> before_;
    std::size_t next_ = 0; ///< in before_; geoms mostly come in the same order
};
} // namespace ode_predictive_space::haptics

#endif
