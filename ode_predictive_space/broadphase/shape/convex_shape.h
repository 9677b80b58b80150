// The shape of an object in its present pose. In: a direction. Out: the reach of the shape.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_CONVEX_SHAPE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_CONVEX_SHAPE_H

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
    unknown,  ///< only the bounding box is known
    rounded,  ///< all points up to `radius` from a box whose sides may be 0: spheres, capsules, boxes
    cylinder, ///< along axes[2], with half_sides[2] and `radius`
    hull,     ///< many points, inside the box of half_sides
    terrain,  ///< a heightfield, solid below; its grid lies around the centre, axes[1] is up
    half_space
};

struct Pose
{
    Vector3 centre = Vector3::Zero(); ///< a point on the surface of a half space
    std::array<Vector3, 3> axes{};    ///< unit vectors; axes[0] of a half space points outwards
};

/// A convex shape, or one with a surface(), in coordinates of the scene. It is finite if its kind is known.
struct ConvexShape : Pose
{
    ShapeKind kind = ShapeKind::unknown;
    Vector3 half_sides = Vector3::Zero(); ///< along the axes
    double radius = 0;
    double size = 0;                        ///< the smallest diameter; infinite for half spaces and terrain
    double slack = 0;                       ///< distance at which colliders may find contacts by rounding of sizes
    double place_slack = 0;                 ///< as above, by rounding of positions
    double slack_beside_own = 0;            ///< additional slack beside shapes of the same group
    double sliver_factor = 1;               ///< factor of `slack` and slack_beside_own, except beside a half space
    std::uint16_t group = 0;                ///< one bit
    std::uint16_t partners = 0;             ///< groups that are tested by shape; others are tested by bounding box
    std::uint16_t blunt_beside = 0;         ///< groups beside which a capsule or cylinder counts as blunt()
    bool awaits_hull = false;               ///< the shape is unknown until the hull of its data is made
    double blunt_margin = 0;                ///< enlargement of blunt() on all sides
    std::shared_ptr<const VertexHull> hull; ///< data of a hull or terrain, relative to centre and axes

    Vector3 along_axes(const Vector3 &direction) const
    {
        return Vector3(axes[0].dot(direction), axes[1].dot(direction), axes[2].dot(direction));
    }
    Vector3 from_axes(const Vector3 &point) const
    {
        return point[0] * axes[0] + point[1] * axes[1] + point[2] * axes[2];
    }

    /// The triangles of a mesh or the heights of a heightfield; null for other shapes.
    Surface *surface() const { return hull ? hull->surface.get() : nullptr; }

    bool known() const { return kind != ShapeKind::unknown; }

    /// Radius of a sphere around the centre that holds the shape. @pre no half space or terrain.
    double bounding_radius() const
    {
        return kind == ShapeKind::cylinder ? std::hypot(half_sides[2], radius) : half_sides.norm() + radius;
    }

    /// Reach of the shape from its centre in a direction of length 1. @pre no half space or terrain.
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

    float work_of_reach() const { return kind == ShapeKind::hull ? hull->work_of_reach() : 1; }

    /// The farthest point of the shape's core, relative to the centre, in a direction of any length. The shape is the set of
    /// all points up to core_distance() from its core. @pre no half space or terrain.
    Vector3 farthest_of_core(const Vector3 &direction) const
    {
        if (kind == ShapeKind::cylinder)
        {
            const double along = axes[2].dot(direction);
            Vector3 across = direction - along * axes[2];
            across -= axes[2].dot(across) * axes[2]; // removes the rounding error along the axis
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

    /// The cylinder around a capsule or cylinder, enlarged by blunt_margin.
    ConvexShape blunt() const
    {
        ConvexShape cylinder = *this;
        cylinder.kind = ShapeKind::cylinder;
        cylinder.half_sides[2] = blunt_half();
        cylinder.radius += blunt_margin;
        cylinder.blunt_beside = 0;
        return cylinder;
    }

    /// Upper bound of the change of the shape's extent in any direction since the pose `before`. A turn about an axis of
    /// symmetry changes nothing; any motion of terrain is infinite, because terrain is solid to any depth. @pre no half space.
    /// A turn changes the reach of a box or hull by at most half_side |change of axis| per axis, that of a cylinder by at most
    /// the chord of its farthest points.
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
        // This is at least the sum of half_side |change of axis| (Cauchy-Schwarz inequality).
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

/// Whether the shapes, and not the bounding boxes, decide if the two can touch.
inline bool judged_by_shape(const ConvexShape &first, const ConvexShape &second)
{
    return (first.partners & second.group) != 0 && (second.partners & first.group) != 0;
}
} // namespace ode_predictive_space

#endif
