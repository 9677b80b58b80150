#include "ode_predictive_space/space/geom_shape.h"

#include <algorithm>
#include <limits>

#include "ode_predictive_space/space/geom_scene.h"
#include "ode_predictive_space/space/rotation.h"

namespace ode_predictive_space
{
namespace
{
// The growth of a sphere's radius reduces its gaps, and enlarges the margin by less than a hundredth of the growth.
constexpr double growth_and_margin = 1.01;

// ODE's roundings that slacks allow for.
constexpr double rounded_places = 16;

constexpr std::uint16_t group_of(int type)
{
    return static_cast<std::uint16_t>(1u << static_cast<unsigned>(type));
}

constexpr std::uint16_t spheres = group_of(dSphereClass), boxes = group_of(dBoxClass),
                        capsules = group_of(dCapsuleClass), cylinders = group_of(dCylinderClass),
                        planes = group_of(dPlaneClass), convexes = group_of(dConvexClass),
                        meshes = group_of(dTriMeshClass), heightfields = group_of(dHeightfieldClass);

constexpr std::uint16_t solids = spheres | boxes | capsules | cylinders | convexes | meshes;

std::uint16_t libccd_partners_of(int type)
{
    switch (type)
    {
    case dSphereClass:
    case dTriMeshClass:
        return convexes;
    case dBoxClass:
    case dCapsuleClass:
        return cylinders | convexes;
    case dCylinderClass:
        return boxes | capsules | cylinders | convexes;
    case dConvexClass:
        return solids;
    default:
        return 0;
    }
}

std::uint16_t partners_of(int type)
{
    const bool is_solid = group_of(type) & solids;
    return is_solid ? (solids | planes | heightfields) & ~libccd_partners_of(type) : solids;
}

// Beside triangles, ODE skips separating directions of a capsule if a product of lengths is below 0.001, of a cylinder if it is
// below 0.00001. The ends of a capsule are then practically flat. If ODE keeps the triangles of the last tick, or skips
// directions because of edge flags, a capsule is touched anywhere in its box.
constexpr double left_out_of_capsule = 1e-3, left_out_of_cylinder = 1e-5;

// Beside another mesh, ODE treats a triangle as coplanar with a point if their distance, times the length of the triangle's
// normal, which is not 1, is below 0.000001.
constexpr double coplanar = 1e-6;

// OPCODE computes the normal of a triangle in single precision, as the product of two sides. Its direction is off by up to 3.5
// roundings times the aspect ratio of the triangle, and its plane, at the other shape, by that part of the distance from a
// corner, which is at most twice the sum of both shapes' half sides. rounded_places cover aspect ratios up to 2. ODE finds the
// nearest point of a triangle to a sphere by a determinant, whose error in single precision grows with the square of the ratio.
double sliver_factor_of(const DataHull &hull)
{
    const double factor = std::max(1.0, hull.aspect / 2);
    return sizeof(dReal) == sizeof(double) ? factor : factor * factor;
}

// A mesh with thinner slivers is judged by shape only beside planes and heightfields.
constexpr double most_sliver_factor = 1000;

bool blunts_capsules_only(dGeomID mesh)
{
    return !dGeomTriMeshIsTCEnabled(mesh, dBoxClass) &&
           dGeomTriMeshDataGet2(dGeomTriMeshGetData(mesh), dTRIMESHDATA_USE_FLAGS, nullptr) == nullptr;
}

// Beside a heightfield, ODE uses the box of a mesh.
bool has_old_box(const ConvexShape &mesh)
{
    return static_cast<const DataHull &>(*mesh.hull).has_old_box;
}

void take_partners(dxGeom *geom, ConvexShape &shape)
{
    shape.group = group_of(geom->type);
    shape.partners = partners_of(geom->type);
    if (geom->type == dCapsuleClass || geom->type == dCylinderClass)
    {
        shape.blunt_beside = meshes;
        shape.blunt_margin = geom->type == dCapsuleClass ? left_out_of_capsule : left_out_of_cylinder;
    }
    else if (geom->type == dTriMeshClass && shape.sliver_factor > most_sliver_factor)
        shape.partners = planes | heightfields;
    else if (geom->type == dTriMeshClass && !blunts_capsules_only(geom))
        shape.partners &= static_cast<std::uint16_t>(~capsules);
    if (geom->type == dTriMeshClass && has_old_box(shape))
        shape.partners &= static_cast<std::uint16_t>(~heightfields);
}

// Geoms that cannot be placed have no pose in ODE.
const dxPosR &pose_of(const dxGeom *geom)
{
    static const dxPosR none = {{0, 0, 0, 0}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
    return geom->gflags & GEOM_PLACEABLE ? *geom->final_posr : none;
}

// @return false if the matrix is no rotation, or the position is too far away.
bool take_pose(dxGeom *geom, ConvexShape &shape)
{
    geom->recomputePosr();
    const dxPosR &pose = pose_of(geom);
    shape.centre = Vector3(pose.pos[0], pose.pos[1], pose.pos[2]);
    for (std::size_t i = 0; i < 3; ++i)
        shape.axes[i] = Vector3(pose.R[i], pose.R[4 + i], pose.R[8 + i]);
    if (shape.hull)
    {
        const Vector3 &offset = shape.hull->centre();
        shape.centre += offset[0] * shape.axes[0] + offset[1] * shape.axes[1] + offset[2] * shape.axes[2];
    }
    shape.place_slack = rounded_places * double{std::numeric_limits<dReal>::epsilon()} * shape.centre.lpNorm<1>();
    return (geom->type == dSphereClass || skew_of(pose.R) <= most_skew) && shape.centre.lpNorm<1>() <= largest_length;
}

bool take_sizes(const dxGeom *geom, ConvexShape &shape)
{
    const dReal *sizes = sizes_of(geom);
    shape.kind = geom->type == dCylinderClass ? ShapeKind::cylinder : ShapeKind::rounded;
    if (geom->type == dBoxClass)
    {
        shape.half_sides = 0.5 * Vector3(sizes[0], sizes[1], sizes[2]);
        shape.size = 2 * shape.half_sides.minCoeff();
    }
    else
    {
        shape.radius = sizes[0];
        shape.half_sides[2] = geom->type == dSphereClass ? 0 : 0.5 * sizes[1];
        shape.size =
            2 * (shape.kind == ShapeKind::cylinder ? std::min(shape.radius, shape.half_sides[2]) : shape.radius);
    }
    return shape.half_sides.lpNorm<1>() + shape.radius <= largest_length;
}

bool take_hull(const dxGeom *geom, const std::shared_ptr<const DataHull> &hull, ConvexShape &shape)
{
    if (!hull)
        return false;
    const bool is_terrain = geom->type == dHeightfieldClass;
    shape.hull = hull;
    shape.slack_beside_own = quotient(2 * coplanar, hull->least_normal);
    shape.sliver_factor = sliver_factor_of(*hull);
    shape.kind = is_terrain ? ShapeKind::terrain : ShapeKind::hull;
    shape.half_sides = hull->half_sides();
    shape.size = is_terrain ? std::numeric_limits<double>::infinity() : 2 * shape.half_sides.minCoeff();
    return true;
}

bool take_plane(const dxGeom *geom, ConvexShape &shape)
{
    const dReal *plane = static_cast<const dxPlane *>(geom)->p;
    shape.kind = ShapeKind::half_space;
    shape.axes.fill(Vector3(plane[0], plane[1], plane[2]));
    shape.centre = double{plane[3]} * shape.axes[0];
    shape.place_slack = rounded_places * double{std::numeric_limits<dReal>::epsilon()} * shape.centre.lpNorm<1>();
    shape.size = std::numeric_limits<double>::infinity();
    return std::abs(shape.axes[0].squaredNorm() - 1) <= most_skew && shape.centre.lpNorm<1>() <= largest_length;
}

bool take_all(dxGeom *geom, const std::shared_ptr<const DataHull> &hull, ConvexShape &shape)
{
    if (geom->gflags & GEOM_ZERO_SIZED)
        return false;
    if (geom->type == dPlaneClass)
        return take_plane(geom, shape);
    const bool has_form = geom->type <= dCylinderClass ? take_sizes(geom, shape) : take_hull(geom, hull, shape);
    return has_form && take_pose(geom, shape);
}

bool keeps_form(dxGeom *geom, const ConvexShape &shape)
{
    if (shape.group != group_of(geom->type) || (geom->gflags & GEOM_ZERO_SIZED))
        return false;
    const dReal *sizes = sizes_of(geom);
    switch (geom->type)
    {
    case dSphereClass:
        return shape.radius == sizes[0];
    case dBoxClass:
        return shape.half_sides == 0.5 * Vector3(sizes[0], sizes[1], sizes[2]);
    case dCapsuleClass:
    case dCylinderClass:
        return shape.radius == sizes[0] && shape.half_sides[2] == 0.5 * sizes[1];
    default:
        return shape.hull && !HullStore::is_outdated(geom, *shape.hull);
    }
}
} // namespace

bool found_by_libccd(const dxGeom *one, const dxGeom *other)
{
    return other->type < dFirstSpaceClass && libccd_partners_of(one->type) & group_of(other->type);
}

ConvexShape shape_of(dxGeom *geom, const std::shared_ptr<const DataHull> &hull)
{
    ConvexShape shape;
    if (!take_all(geom, hull, shape))
        return {};
    // Beside meshes, ODE rounds sizes to single precision.
    const Vector3 offset = shape.hull ? shape.hull->centre() : Vector3::Zero();
    shape.slack = rounded_places * double{std::numeric_limits<float>::epsilon()} *
                  (shape.half_sides.lpNorm<1>() + shape.radius + offset.lpNorm<1>());
    take_partners(geom, shape);
    return shape;
}

double follow_geom(ProxyId id, dxGeom *geom, HullStore &hulls, std::size_t &steps, ConvexShape &shape)
{
    const Pose before = shape;
    if (keeps_form(geom, shape) && take_pose(geom, shape))
        return shape.moved_from(before);
    const bool was_sphere = shape.group == group_of(dSphereClass);
    const double radius_before = shape.radius;
    const HullStore::Found found = has_data(geom) ? hulls.hull_of(id, geom, steps) : HullStore::Found();
    shape = shape_of(geom, found.hull);
    shape.awaits_hull = found.is_being_made;
    if (was_sphere && shape.known())
        return shape.moved_from(before) + growth_and_margin * std::max(0.0, shape.radius - radius_before);
    return std::numeric_limits<double>::infinity();
}
} // namespace ode_predictive_space
