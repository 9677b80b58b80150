// Lower bounds of the distance of two shapes.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_GAP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_GAP_H

#include <limits>

#include "ode_predictive_space/broadphase/shape/convex_shape.h"

namespace ode_predictive_space
{
/// A lower bound of the distance of two shapes, and the axis along which it was found. A length that is not positive is no gap.
struct Gap
{
    double length = -std::numeric_limits<double>::infinity();
    Vector3 axis = Vector3::Zero(); ///< from the first shape to the second; unit length, or zero if unknown
    /// Work of the whole search, in evaluations of ConvexShape::reach(). A hull counts once per visited block; the distance of
    /// a triangle and a cell of a terrain count once, because they cost about as much.
    float work = 0;

    void improve(const Gap &other)
    {
        const float sum = work + other.work;
        if (other.length > length)
            *this = other;
        work = sum;
    }
};

/// Maximum relative error of distances in the frame of a shape: matrices are rotations only to 1e-6.
constexpr double skew_of_distances = 1e-5;

/// Upper bound of the round-off of a shape's position and extent.
double rounding(const ConvexShape &shape);

/// The gap along a direction of any length but 0, rounded down. If one of the shapes is a half space, the axis is its normal.
Gap gap_along(const Vector3 &direction, const ConvexShape &first, const ConvexShape &second);

/// The largest gap that a few steps find. No gap unless the pair is judged_by_shape().
/// @param axis to begin with, or zero.
/// @param least the smallest useful gap, at least 0. The search ends if no larger one is possible, or if the gap along `axis`
///     is larger and at least half of the largest possible one.
Gap find_gap(const ConvexShape &first, const ConvexShape &second, const Vector3 &axis, double least);
} // namespace ode_predictive_space

#endif
