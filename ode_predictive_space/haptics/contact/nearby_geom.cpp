#include "ode_predictive_space/haptics/contact/nearby_geom.h"

#include "ode_predictive_space/haptics/contact/ode_vector.h"

#include <ode/objects.h>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double least_winding = 0.5;           // inside of a mesh
constexpr double least_winding_of_field = 0.25; // below a heightfield, which has no bottom
} // namespace

NearbyGeom::NearbyGeom(dGeomID geom)
    : id_(geom), object_(object_of(geom)), pose_(pose_of(geom)), motion_(body_motion_of(geom, pose_)),
      mobility_(Mobility::of(dGeomGetBody(geom)))
{}

std::optional<NearbyGeom> NearbyGeom::read(dGeomID geom, MeshStore &meshes, const TriangleList &touched)
{
    const Solid solid = Solid::of(geom);
    if (!solid.is_known() && !meshes.knows(geom))
        return {};
    NearbyGeom nearby(geom);
    nearby.solid_ = solid;
    if (solid.is_ball())
        nearby.pose_.rotation.setIdentity();
    if (!nearby.is_solid() && nearby.is_finite())
    {
        nearby.mesh_ = meshes.tree_of(geom, touched);
        if (!nearby.mesh_)
            return {};
        nearby.is_field_ = dGeomGetClass(geom) == dHeightfieldClass;
    }
    return nearby;
}

NearbyGeom NearbyGeom::behind_plane(dGeomID geom, const Vector3 &point, const Vector3 &normal)
{
    NearbyGeom nearby(geom);
    nearby.pose_.rotation.setIdentity();
    nearby.solid_ = Solid::half_space(nearby.to_local(point), normal);
    nearby.by_plane_ = true;
    nearby.point_ = point;
    return nearby;
}

/// ODE's normal points out of the second geom, towards the probe.
NearbyGeom NearbyGeom::at_contact(dGeomID geom, const dContactGeom &contact, const Vector3 &tool)
{
    const Vector3 point = from_ode(contact.pos), normal = from_ode(contact.normal);
    NearbyGeom nearby = behind_plane(geom, point, normal);
    nearby.lever_ = point - static_cast<double>(contact.depth) * normal - tool;
    return nearby;
}

NearbyGeom NearbyGeom::of(const ProbeTool &tool)
{
    NearbyGeom nearby;
    nearby.solid_ = Solid::sphere(tool.radius);
    nearby.id_ = tool.region;
    nearby.object_ = tool.object;
    nearby.pose_.position = tool.centre;
    nearby.motion_ = {tool.centre, tool.velocity, Vector3::Zero()};
    return nearby;
}

NearbyGeom NearbyGeom::later(double dt) const
{
    NearbyGeom geom = *this;
    geom.mesh_ = std::shared_ptr<const MeshTree>(std::shared_ptr<const void>(), mesh_.get());
    if (motion_.linear.allFinite() && motion_.angular.allFinite())
        geom.shift(dt * motion_.linear, dt * motion_.angular, Vector3::Zero(), Vector3::Zero());
    return geom;
}

void NearbyGeom::shift(const Vector3 &moved, const Vector3 &turned, const Vector3 &velocity, const Vector3 &spin)
{
    pose_.position += moved;
    point_ += moved;
    motion_.centre += moved;
    const double angle = turned.norm();
    if (by_plane_)
        pose_.position += turned.cross(point_ - motion_.centre);
    else if (angle != 0)
    {
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, turned / angle).toRotationMatrix();
        if (!solid_.is_ball())
            pose_.rotation = turn * pose_.rotation;
        pose_.position = motion_.centre + turn * (pose_.position - motion_.centre);
    }
    motion_.linear += velocity;
    motion_.angular += spin;
}

double NearbyGeom::speed_of_plane() const
{
    return by_plane_ ? std::abs(solid_.nearest(to_local(point_)).normal.dot(velocity_at(point_))) : 0;
}

void NearbyGeom::note_contacts()
{
    in_contact_ = false;
    const dBodyID body = is_movable() ? dGeomGetBody(id_) : nullptr;
    for (int i = 0; body != nullptr && i < dBodyGetNumJoints(body); ++i)
        in_contact_ = in_contact_ || dJointGetType(dBodyGetJoint(body, i)) == dJointTypeContact;
}

void NearbyGeom::push(const Vector3 &impulse, const Vector3 &arm, double since)
{
    const Vector3 velocity = mobility_.inverse_mass * impulse;
    const Vector3 spin = mobility_.inverse_inertia * arm.cross(impulse);
    shift(since * velocity, since * spin, velocity, spin);
}

double NearbyGeom::collect(const Vector3 &point, double radius, SurfaceFeatures &features,
                           MeshTree::Budget *budget) const
{
    const std::size_t first = features.size();
    double nearest = radius;
    if (mesh_)
    {
        nearest = mesh_->collect(to_local(point), radius, features, budget);
    }
    else
    {
        const SurfaceFeature feature = solid_.nearest(to_local(point));
        if (feature.distance <= radius)
        {
            features.push_back(feature);
            nearest = feature.distance;
        }
    }
    for (std::size_t i = first; i < features.size(); ++i)
        move_to_scene(features[i]);
    return nearest;
}

double NearbyGeom::distance(const Vector3 &point, double most) const
{
    const Vector3 local = to_local(point);
    return mesh_ ? mesh_->distance(local, most) : std::min(most, solid_.nearest(local).distance);
}

bool NearbyGeom::contains(const Vector3 &point) const
{
    return mesh_ && mesh_->winding_number(to_local(point)) > (is_field_ ? least_winding_of_field : least_winding);
}

SurfaceFeature NearbyGeom::nearest_of(const SurfaceFeature &feature, const Vector3 &point) const
{
    SurfaceFeature seen = mesh_ ? mesh_->nearest_of(static_cast<std::size_t>(feature.triangle), to_local(point))
                                : solid_.nearest(to_local(point));
    move_to_scene(seen);
    return seen;
}

Touch NearbyGeom::touch_of(const SurfaceFeature &feature) const
{
    Touch touch;
    touch.point = feature.point;
    touch.normal = feature.normal;
    touch.depth = -feature.distance;
    touch.surface_velocity = velocity_at(touch.point);
    touch.mobility = mobility_at(touch.point, touch.normal);
    touch.response_time = step_;
    touch.arm = arm_of(touch.point);
    touch.object = object_;
    touch.material = material_;
    return touch;
}

void NearbyGeom::move_to_scene(SurfaceFeature &feature) const
{
    feature.point = to_scene(feature.point);
    feature.normal = pose_.rotation * feature.normal;
}
} // namespace ode_predictive_space::haptics
