#include "ode_predictive_space/space/geom_shape.h"

#include <algorithm>
#include <limits>

#include "ode_predictive_space/space/geom_scene.h"

namespace ode_predictive_space
{
namespace
{
constexpr bool is_double = sizeof(dReal) == sizeof(double);

// A rotation matrix is integrated and normalised, so it is not exact. What it is off is a small part of the slack.
constexpr double most_skew = is_double ? 1e-6 : 1e-5;

// Beyond this, squares of lengths may overflow.
constexpr double largest_length = 1e100;

constexpr std::uint8_t group_of(int type)
{
    return static_cast<std::uint8_t>(1u << static_cast<unsigned>(type));
}

constexpr std::uint8_t spheres = group_of(dSphereClass), boxes = group_of(dBoxClass),
                       capsules = group_of(dCapsuleClass), cylinders = group_of(dCylinderClass),
                       planes = group_of(dPlaneClass);

// ODE has libccd find the contacts of cylinders with capsules, with other cylinders and, in some builds, with boxes. It finds some
// between shapes that are apart by a tenth of their size and more.
std::uint8_t partners_of(int type)
{
    switch (type)
    {
    case dSphereClass:
        return spheres | boxes | capsules | cylinders | planes;
    case dBoxClass:
    case dCapsuleClass:
        return spheres | boxes | capsules | planes;
    case dCylinderClass:
        return spheres | planes;
    default:
        return spheres | boxes | capsules | cylinders;
    }
}

bool take_pose(const dxPosR &pose, ConvexShape &shape)
{
    shape.centre = Vector3(pose.pos[0], pose.pos[1], pose.pos[2]);
    for (std::size_t i = 0; i < 3; ++i)
        shape.axes[i] = Vector3(pose.R[i], pose.R[4 + i], pose.R[8 + i]);
    double skew = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            skew += std::abs(shape.axes[i].dot(shape.axes[j]) - (i == j ? 1 : 0));
    return skew <= most_skew && shape.centre.lpNorm<1>() <= largest_length;
}

void take_sizes(const dxGeom *geom, ConvexShape &shape)
{
    const dReal *sizes = sizes_of(geom);
    shape.kind = geom->type == dCylinderClass ? ShapeKind::cylinder : ShapeKind::rounded;
    if (geom->type == dBoxClass)
    {
        shape.half_sides = 0.5 * Vector3(sizes[0], sizes[1], sizes[2]);
        shape.size = 2 * shape.half_sides.minCoeff();
        return;
    }
    shape.radius = sizes[0];
    shape.size = 2 * shape.radius;
    if (geom->type == dSphereClass)
        return;
    shape.half_sides[2] = 0.5 * sizes[1];
    if (geom->type != dCylinderClass)
        return;
    shape.size = std::min(shape.size, 2 * shape.half_sides[2]);
    shape.axes[2].normalize();
}

bool take_plane(dxGeom *geom, ConvexShape &shape)
{
    const dReal *plane = static_cast<const dxPlane *>(geom)->p;
    shape.kind = ShapeKind::half_space;
    shape.axes.fill(Vector3(plane[0], plane[1], plane[2]));
    shape.centre = double{plane[3]} * shape.axes[0];
    shape.size = std::numeric_limits<double>::infinity();
    return std::abs(shape.axes[0].squaredNorm() - 1) <= most_skew && shape.centre.lpNorm<1>() <= largest_length;
}
} // namespace

ConvexShape shape_of(dxGeom *geom)
{
    ConvexShape shape;
    const bool is_plane = geom->type == dPlaneClass;
    if (static_cast<unsigned>(geom->type) > dCylinderClass && !is_plane)
        return shape;
    if (geom->gflags & GEOM_ZERO_SIZED)
        return shape;
    if (!is_plane)
    {
        geom->recomputePosr();
        take_sizes(geom, shape);
    }
    const double lengths = shape.half_sides.lpNorm<1>() + shape.radius;
    const bool good =
        is_plane ? take_plane(geom, shape) : take_pose(*geom->final_posr, shape) && lengths <= largest_length;
    if (!good)
        return {};
    // Some roundings of ODE's, in its precision.
    shape.slack = 16 * double{std::numeric_limits<dReal>::epsilon()} * (shape.centre.lpNorm<1>() + lengths);
    shape.group = group_of(geom->type);
    shape.partners = partners_of(geom->type);
    return shape;
}
} // namespace ode_predictive_space
