// The shape of an object where it is now. In: a direction. Out: how far the shape reaches.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_CONVEX_SHAPE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_CONVEX_SHAPE_H

#include <array>
#include <cmath>
#include <cstdint>

#include "ode_predictive_space/prediction/path.h"

namespace ode_predictive_space
{
enum class ShapeKind : std::uint8_t
{
    unknown,  ///< the object is judged by its bounding box
    rounded,  ///< all points up to `radius` away from a box; the sides of the box may be 0: spheres, capsules, boxes
    cylinder, ///< around axes[2]; half_sides[2] and `radius`
    half_space
};

/// A convex shape, in coordinates of the scene. Finite, if its kind is known.
struct ConvexShape
{
    ShapeKind kind = ShapeKind::unknown;
    Vector3 centre = Vector3::Zero();     ///< of a half space, a point on its surface
    std::array<Vector3, 3> axes{};        ///< unit vectors; of a half space, axes[0] points out of it
    Vector3 half_sides = Vector3::Zero(); ///< along the axes
    double radius = 0;
    double size = 0;  ///< the smallest of its diameters; infinite for a half space
    double slack = 0; ///< a length: contacts may be found when the shapes are so far apart, because that test rounds
    std::uint8_t group = 0;    ///< one bit
    std::uint8_t partners = 0; ///< the groups with which the shape decides; with others it is the bounding box

    bool known() const { return kind != ShapeKind::unknown; }

    /// How far the shape reaches from its centre in a direction of length 1. Not for half spaces.
    double reach(const Vector3 &direction) const
    {
        if (kind == ShapeKind::cylinder)
        {
            const double along = axes[2].dot(direction);
            return half_sides[2] * std::abs(along) + radius * (direction - along * axes[2]).norm();
        }
        double sum = radius;
        for (std::size_t i = 0; i < 3; ++i)
            sum += half_sides[static_cast<Eigen::Index>(i)] * std::abs(axes[i].dot(direction));
        return sum;
    }

    /// The point of the shape's core that is farthest in a direction of any length, from the centre. The shape is the set of all
    /// points up to core_distance() away from its core.
    Vector3 farthest_of_core(const Vector3 &direction) const
    {
        if (kind == ShapeKind::cylinder)
        {
            const double along = axes[2].dot(direction);
            const Vector3 across = direction - along * axes[2];
            const double length = across.norm();
            const Vector3 end = std::copysign(half_sides[2], along) * axes[2];
            return length > 0 ? Vector3(end + (radius / length) * across) : end;
        }
        Vector3 point = Vector3::Zero();
        for (std::size_t i = 0; i < 3; ++i)
            point += std::copysign(half_sides[static_cast<Eigen::Index>(i)], axes[i].dot(direction)) * axes[i];
        return point;
    }

    double core_distance() const { return kind == ShapeKind::cylinder ? 0 : radius; }

    bool same_size(const ConvexShape &other) const
    {
        return kind == other.kind && half_sides == other.half_sides && radius == other.radius;
    }

    /// An upper bound of the distance that any point of the surface has moved from `before`, a shape of the same size, if each
    /// is taken to the nearest point that serves: turning about an axis of symmetry moves nothing. Not for half spaces.
    ///
    /// The reach in any direction changes by no more: the sum of half_side |axis . direction| by half_side |change of axis|
    /// each, that of a cylinder by the chord of its farthest points.
    double moved_from(const ConvexShape &before) const
    {
        double sum = (centre - before.centre).norm();
        if (kind == ShapeKind::cylinder)
            return sum + std::hypot(half_sides[2], radius) * (axes[2] - before.axes[2]).norm();
        for (std::size_t i = 0; i < 3; ++i)
            sum += half_sides[static_cast<Eigen::Index>(i)] * (axes[i] - before.axes[i]).norm();
        return sum;
    }
};
/// Do the shapes decide whether the two can touch?
inline bool judged_by_shape(const ConvexShape &first, const ConvexShape &second)
{
    return (first.partners & second.group) != 0;
}
} // namespace ode_predictive_space

#endif
