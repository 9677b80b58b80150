// The motion of the geoms around the probe, including geoms that the program poses without a velocity.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_POSE_WATCH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_POSE_WATCH_H

#include "ode_predictive_space/haptics/contact/short_list.h"

#include <cstdint>
#include <ode/common.h>

namespace ode_predictive_space::haptics
{
struct Pose
{
    Vector3 position = Vector3::Zero(); ///< m
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

/// The pose of any geom; planes are at the origin.
Pose pose_of(dGeomID geom);

struct Motion
{
    Vector3 centre = Vector3::Zero();  ///< m
    Vector3 linear = Vector3::Zero();  ///< m/s; of the centre
    Vector3 angular = Vector3::Zero(); ///< rad/s

    Vector3 velocity_at(const Vector3 &point) const { return linear + angular.cross(point - centre); }
};

/// The motion of the geom's body; zero without a body.
Motion body_motion_of(dGeomID geom, const Pose &pose);

/// Estimates velocities from poses: tracked objects, lifts and doors are often posed in each tick, without a velocity.
/// Call order in each tick: begin(), then motion_of() for each geom of the near callback.
class PoseWatch
{
public:
    /// m/s; a geom that is posed farther away in a tick was put there. A tenth above the promised 2 m/s, because ticks vary.
    static constexpr double fastest = 2.2;

    void begin() { seen_.begin(); }

    /// The motion of the body, or that of the poses if it is faster than the body is now and was a tick ago.
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

    TwoTicks<Seen> seen_;
};
} // namespace ode_predictive_space::haptics

#endif
