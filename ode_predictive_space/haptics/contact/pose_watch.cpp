#include "ode_predictive_space/haptics/contact/pose_watch.h"

#include "ode_predictive_space/haptics/contact/ode_vector.h"

#include <ode/collision.h>
#include <ode/objects.h>

namespace ode_predictive_space::haptics
{
namespace
{
// A stepped body moves by its velocity, except for rounding and the curvature of a rotation.
constexpr double explained = 1.05;
constexpr double rounding = sizeof(dReal) == sizeof(double) ? 1e-6 : 1e-2; // m/s

Motion between(const Pose &before, const Pose &now, const Vector3 &centre, double seconds)
{
    const Eigen::Matrix3d turn = now.rotation * before.rotation.transpose();
    const Vector3 was_at = before.position + turn.transpose() * (centre - now.position);
    const Eigen::AngleAxisd turned(turn);
    return {centre, (centre - was_at) / seconds, turned.angle() / seconds * turned.axis()};
}
} // namespace

Pose pose_of(dGeomID geom)
{
    Pose pose;
    dVector3 in_scene; // these functions accept planes, too
    dGeomGetRelPointPos(geom, 0, 0, 0, in_scene);
    pose.position = from_ode(in_scene);
    for (int axis = 0; axis < 3; ++axis)
    {
        dGeomVectorToWorld(geom, axis == 0, axis == 1, axis == 2, in_scene);
        pose.rotation.col(axis) = from_ode(in_scene);
    }
    return pose;
}

Motion body_motion_of(dGeomID geom, const Pose &pose)
{
    const dBodyID body = dGeomGetBody(geom);
    if (body == nullptr)
        return {pose.position, Vector3::Zero(), Vector3::Zero()};
    return {from_ode(dBodyGetPosition(body)), from_ode(dBodyGetLinearVel(body)), from_ode(dBodyGetAngularVel(body))};
}

Motion PoseWatch::motion_of(dGeomID geom, const Pose &pose, const Vector3 &where, double tick)
{
    const Motion by_body = body_motion_of(geom, pose);
    seen_.now.push_back({geom, object_of(geom), pose, by_body});
    const auto is_it = [geom, object = object_of(geom)](const Seen &seen) {
        return seen.geom == geom && seen.object == object;
    };
    const Seen *last = find_in(seen_.before, is_it);
    if (last == nullptr || !(tick > 0))
        return by_body;
    const Motion by_poses = between(last->pose, pose, by_body.centre, tick);
    const double speed = by_poses.velocity_at(where).norm();
    const double known = std::max(by_body.velocity_at(where).norm(), last->by_body.velocity_at(where).norm());
    const bool is_posed = speed > explained * known + rounding && speed <= fastest;
    return is_posed ? by_poses : by_body;
}
} // namespace ode_predictive_space::haptics
