#include "ode_predictive_space/haptics/contact/nearby_geom.h"

#include "ode_predictive_space/haptics/touch_sensor.h"

namespace ode_predictive_space::haptics
{
namespace
{
Vector3 from_ode(const dReal *v)
{
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

Eigen::Matrix3d rotation_from_ode(const dReal *r)
{
    Eigen::Matrix3d rotation;
    for (int row = 0; row < 3; ++row)
    {
        rotation.row(row) = from_ode(r + std::ptrdiff_t{4} * row);
    }
    return rotation;
}
} // namespace

std::optional<NearbyGeom> NearbyGeom::read(dGeomID geom, MeshStore &meshes, const TriangleList &touched)
{
    NearbyGeom nearby;
    nearby.solid_ = Solid::of(geom);
    if (!nearby.is_solid() && (dGeomGetClass(geom) != dTriMeshClass || dGeomTriMeshGetData(geom) == nullptr))
    {
        return {};
    }
    nearby.id_ = geom;
    nearby.object_ = object_of(geom);
    if (dGeomGetClass(geom) != dPlaneClass)
    {
        nearby.rotation_ = rotation_from_ode(dGeomGetRotation(geom));
        nearby.position_ = from_ode(dGeomGetPosition(geom));
    }
    if (const dBodyID body = dGeomGetBody(geom))
    {
        nearby.linear_ = from_ode(dBodyGetLinearVel(body));
        nearby.angular_ = from_ode(dBodyGetAngularVel(body));
        nearby.centre_ = from_ode(dBodyGetPosition(body));
    }
    if (!nearby.is_solid() && nearby.is_finite())
    {
        nearby.mesh_ = meshes.tree_of(geom, touched);
    }
    return nearby;
}

NearbyGeom NearbyGeom::later(double dt) const
{
    NearbyGeom geom = *this;
    geom.mesh_ = std::shared_ptr<const MeshTree>(std::shared_ptr<const void>(), mesh_.get());
    if (!linear_.allFinite() || !angular_.allFinite())
    {
        return geom;
    }
    geom.centre_ += dt * linear_;
    geom.position_ += dt * linear_;
    const double angle = dt * angular_.norm();
    if (angle != 0)
    {
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, angular_.normalized()).toRotationMatrix();
        geom.rotation_ = turn * rotation_;
        geom.position_ = geom.centre_ + turn * (position_ - centre_);
    }
    return geom;
}

double NearbyGeom::collect(const Vector3 &point, double radius, SurfaceFeatures &features) const
{
    const std::size_t first = features.size();
    double nearest = radius;
    if (mesh_)
    {
        nearest = mesh_->collect(to_local(point), radius, features);
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
    {
        move_to_scene(features[i]);
    }
    return nearest;
}

SurfaceFeature NearbyGeom::nearest_of(const SurfaceFeature &feature, const Vector3 &point) const
{
    SurfaceFeature seen = mesh_ ? mesh_->nearest_of(static_cast<std::size_t>(feature.triangle), to_local(point))
                                : solid_.nearest(to_local(point));
    move_to_scene(seen);
    return seen;
}

void NearbyGeom::move_to_scene(SurfaceFeature &feature) const
{
    feature.point = to_scene(feature.point);
    feature.normal = rotation_ * feature.normal;
}
} // namespace ode_predictive_space::haptics
