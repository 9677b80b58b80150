#include "ode_predictive_space/haptics/contact/solid.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
/// The feature of a ball; at its centre, the normal is arbitrary.
SurfaceFeature nearest_of_ball(const Vector3 &point, const Vector3 &centre, double radius)
{
    SurfaceFeature feature;
    const double distance = (point - centre).norm();
    if (distance > 0)
        feature.normal = (point - centre) / distance;
    feature.distance = distance - radius;
    feature.point = centre + radius * feature.normal;
    return feature;
}

SurfaceFeature nearest_of_box(const Vector3 &point, const Vector3 &half)
{
    SurfaceFeature feature = nearest_of_ball(point, point.cwiseMax(-half).cwiseMin(half), 0);
    if (feature.distance > 0)
        return feature;
    int axis = 0;
    feature.distance = -(half - point.cwiseAbs()).minCoeff(&axis);
    feature.normal = std::copysign(1.0, point[axis]) * Vector3::Unit(axis);
    feature.point[axis] = std::copysign(half[axis], point[axis]);
    return feature;
}

SurfaceFeature nearest_of_cylinder(const Vector3 &point, double radius, double half_length)
{
    const double off_axis = point.head<2>().norm();
    const Vector3 outwards = off_axis > 0 ? Vector3(point.x() / off_axis, point.y() / off_axis, 0) : Vector3::UnitX();
    const double beside = off_axis - radius;
    const double beyond = std::abs(point.z()) - half_length;
    const Vector3 along = std::copysign(1.0, point.z()) * Vector3::UnitZ();

    SurfaceFeature feature;
    if (beside > 0 && beyond > 0) // the rim
    {
        feature.distance = std::hypot(beside, beyond);
        feature.normal = (beside * outwards + beyond * along) / feature.distance;
    }
    else
    {
        feature.distance = std::max(beside, beyond);
        feature.normal = beside > beyond ? outwards : along;
    }
    feature.point = point - feature.distance * feature.normal;
    return feature;
}
} // namespace

Solid Solid::of(dGeomID geom)
{
    Solid solid;
    dReal first = 0;
    dReal second = 0;
    dVector4 numbers = {};
    const int geom_class = dGeomGetClass(geom);
    switch (geom_class)
    {
    case dSphereClass:
        solid.size_ = Vector3(dGeomSphereGetRadius(geom), 0, 0);
        break;
    case dBoxClass:
        dGeomBoxGetLengths(geom, numbers);
        solid.size_ = 0.5 * Vector3(numbers[0], numbers[1], numbers[2]);
        break;
    case dCapsuleClass:
        dGeomCapsuleGetParams(geom, &first, &second);
        solid.size_ = Vector3(first, 0.5 * second, 0);
        break;
    case dCylinderClass:
        dGeomCylinderGetParams(geom, &first, &second);
        solid.size_ = Vector3(first, 0.5 * second, 0);
        break;
    case dPlaneClass:
        dGeomPlaneGetParams(geom, numbers);
        solid.size_ = Vector3(numbers[0], numbers[1], numbers[2]);
        solid.height_ = static_cast<double>(numbers[3]);
        break;
    default:
        return solid;
    }
    solid.class_ = geom_class;
    return solid;
}

Solid Solid::sphere(double radius)
{
    Solid solid;
    solid.size_ = Vector3(radius, 0, 0);
    solid.class_ = dSphereClass;
    return solid;
}

Solid Solid::half_space(const Vector3 &point, const Vector3 &normal)
{
    Solid solid;
    solid.size_ = normal;
    solid.height_ = normal.dot(point);
    solid.class_ = dPlaneClass;
    return solid;
}

SurfaceFeature Solid::nearest(const Vector3 &point) const
{
    switch (class_)
    {
    case dBoxClass:
        return nearest_of_box(point, size_);
    case dSphereClass:
    case dCapsuleClass:
        return nearest_of_ball(point, Vector3(0, 0, std::clamp(point.z(), -size_[1], size_[1])), size_[0]);
    case dCylinderClass:
        return nearest_of_cylinder(point, size_[0], size_[1]);
    default: // a half-space
        break;
    }
    SurfaceFeature feature;
    feature.normal = size_;
    feature.distance = size_.dot(point) - height_;
    feature.point = point - feature.distance * size_;
    return feature;
}
} // namespace ode_predictive_space::haptics
