// The shape of an object where it is now. In: a direction. Out: how far the shape reaches.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_CONVEX_SHAPE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_CONVEX_SHAPE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "ode_predictive_space/broadphase/shape/vertex_hull.h"
#include "ode_predictive_space/prediction/path.h"

namespace ode_predictive_space
{
enum class ShapeKind : std::uint8_t
{
    unknown,  ///< the object is judged by its bounding box
    rounded,  ///< all points up to `radius` away from a box; the sides of the box may be 0: spheres, capsules, boxes
    cylinder, ///< around axes[2]; half_sides[2] and `radius`
    hull,     ///< of many points, within the box of half_sides
    terrain,  ///< a heightfield: no hull holds it; its grid lies around the centre, axes[1] is up
    half_space
};

struct Pose
{
    Vector3 centre = Vector3::Zero(); ///< of a half space, a point on its surface
    std::array<Vector3, 3> axes{};    ///< unit vectors; of a half space, axes[0] points out of it
};

/// A convex shape, or one that has a surface(), in coordinates of the scene. Finite, if its kind is known.
struct ConvexShape : Pose
{
    ShapeKind kind = ShapeKind::unknown;
    Vector3 half_sides = Vector3::Zero(); ///< along the axes
    double radius = 0;
    double size = 0;  ///< the smallest of its diameters; infinite for a half space
    double slack = 0; ///< a length: contacts may be found when the shapes are so far apart, because that test rounds
    double place_slack = 0;      ///< the same, for the rounding of places
    double slack_beside_own = 0; ///< the same, beside shapes of the same group
    double sliver_factor = 1;    ///< by which slacks that follow from sizes are larger, but beside a half space
    std::uint16_t group = 0;     ///< one bit
    std::uint16_t partners = 0;  ///< the groups with which the shape decides; with others it is the bounding box
    std::uint16_t blunt_beside =
        0;                    ///< the groups beside which a capsule or cylinder counts as the cylinder around it, ...
    bool awaits_hull = false; ///< the shape is unknown until the hull of its data is made
    double blunt_margin = 0;  ///< ... larger by this on all sides
    std::shared_ptr<const VertexHull> hull; ///< of a hull or terrain; relative to centre and axes

    Vector3 along_axes(const Vector3 &direction) const
    {
        return Vector3(axes[0].dot(direction), axes[1].dot(direction), axes[2].dot(direction));
    }
    Vector3 from_axes(const Vector3 &point) const
    {
        return point[0] * axes[0] + point[1] * axes[1] + point[2] * axes[2];
    }

    /// What is touched of a mesh or heightfield, or null.
    const std::shared_ptr<Surface> &surface() const
    {
        static const std::shared_ptr<Surface> none;
        return hull ? hull->surface : none;
    }

    bool known() const { return kind != ShapeKind::unknown; }

    /// Of the sphere around the centre that holds the shape. Not for half spaces and terrain.
    double bounding_radius() const
    {
        return kind == ShapeKind::cylinder ? std::hypot(half_sides[2], radius) : half_sides.norm() + radius;
    }

    /// How far the shape reaches from its centre in a direction of length 1. Not for half spaces and terrain.
    double reach(const Vector3 &direction) const
    {
        if (kind == ShapeKind::cylinder)
        {
            const double along = axes[2].dot(direction);
            return half_sides[2] * std::abs(along) + radius * (direction - along * axes[2]).norm();
        }
        if (kind == ShapeKind::hull)
            return hull->reach(along_axes(direction));
        return radius + half_sides.dot(along_axes(direction).cwiseAbs());
    }

    /// The work of reach() and of farthest_of_core(); see Gap::work.
    float work_of_reach() const { return kind == ShapeKind::hull ? hull->work_of_reach() : 1; }

    /// The point of the shape's core that is farthest in a direction of any length, from the centre. The shape is the set of all
    /// points up to core_distance() away from its core. Not for half spaces and terrain.
    Vector3 farthest_of_core(const Vector3 &direction) const
    {
        if (kind == ShapeKind::cylinder)
        {
            const double along = axes[2].dot(direction);
            Vector3 across = direction - along * axes[2];
            across -= axes[2].dot(across) * axes[2]; // what rounding has left along the axis
            constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
            const bool is_along = across.squaredNorm() <= rounding * rounding * direction.squaredNorm();
            const Vector3 end = std::copysign(half_sides[2], along) * axes[2];
            return is_along ? end : Vector3(end + (radius / across.norm()) * across);
        }
        const Vector3 along = along_axes(direction);
        if (kind == ShapeKind::hull)
            return from_axes(hull->farthest(along));
        return from_axes(
            half_sides.binaryExpr(along, [](double side, double sign) { return std::copysign(side, sign); }));
    }

    double core_distance() const { return kind == ShapeKind::cylinder ? 0 : radius; }

    /// The cylinder around a capsule or cylinder.
    ConvexShape blunt() const
    {
        ConvexShape cylinder = *this;
        cylinder.kind = ShapeKind::cylinder;
        cylinder.half_sides[2] = blunt_half();
        cylinder.radius += blunt_margin;
        cylinder.blunt_beside = 0;
        return cylinder;
    }

    /// An upper bound of the distance that any point of the surface has moved from `before`, its own former pose, if each
    /// is taken to the nearest point that serves: turning about an axis of symmetry moves nothing. Terrain that moves has moved
    /// infinitely far, as it is solid however deep. Not for half spaces.
    ///
    /// The reach in any direction changes by no more: the sum of half_side |axis . direction| by half_side |change of axis|
    /// each, that of a cylinder by the chord of its farthest points, and a point of a hull by its coordinates, which are no
    /// larger than the half sides, times the changes of the axes.
    double moved_from(const Pose &before) const
    {
        if (kind == ShapeKind::terrain)
            return centre == before.centre && axes == before.axes ? 0 : std::numeric_limits<double>::infinity();
        const double sum = (centre - before.centre).norm();
        if (kind == ShapeKind::cylinder || blunt_beside)
        {
            const double half = blunt_half(), across = radius + blunt_margin;
            return sum + std::sqrt(half * half + across * across) * (axes[2] - before.axes[2]).norm();
        }
        // By the means of squares, no less than half_side |change of axis|, summed up.
        double squares = 0;
        int sides = 0;
        for (std::size_t i = 0; i < 3; ++i)
        {
            const double side = half_sides[static_cast<Eigen::Index>(i)];
            squares += side * side * (axes[i] - before.axes[i]).squaredNorm();
            sides += side > 0;
        }
        return sum + std::sqrt(sides * squares);
    }

private:
    double blunt_half() const { return half_sides[2] + (kind == ShapeKind::cylinder ? 0 : radius) + blunt_margin; }
};

/// Do the shapes decide whether the two can touch?
inline bool judged_by_shape(const ConvexShape &first, const ConvexShape &second)
{
    return (first.partners & second.group) != 0 && (second.partners & first.group) != 0;
}
} // namespace ode_predictive_space

#endif
