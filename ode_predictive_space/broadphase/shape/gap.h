// How far two shapes are apart, from below.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_GAP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_GAP_H

#include <limits>

#include "ode_predictive_space/broadphase/shape/convex_shape.h"

namespace ode_predictive_space
{
/// An axis and the gap along it: the shapes' distance is at least the gap. No gap, if it is not positive.
struct Gap
{
    double length = -std::numeric_limits<double>::infinity();
    Vector3 axis = Vector3::Zero(); ///< from the first shape to the second; of length 1, or zero when none is known
    /// The evaluations of ConvexShape::reach() that finding it has taken, and finding all that were no larger. A hull counts for each
    /// block that is visited. A triangle's distance and a cell of a terrain count for one each, since they cost about as much.
    float work = 0;

    void improve(const Gap &other)
    {
        const float sum = work + other.work;
        if (other.length > length)
            *this = other;
        work = sum;
    }
};

/// Two shapes are nearer to each other by this part of their distance than they seem in the frame of one of them, because rotation
/// matrices are rotations to 1e-6 only.
constexpr double skew_of_distances = 1e-5;

/// By this, what is computed of a shape's place may be wrong.
double rounding(const ConvexShape &shape);

/// The gap along a direction of any length but 0, rounded down. One of the shapes may be a half space: then the axis is its own.
Gap gap_along(const Vector3 &direction, const ConvexShape &first, const ConvexShape &second);

/// The largest gap that a few tries find. No gap unless the pair is judged_by_shape().
///
/// @param axis an axis to begin with, or zero.
/// @param least no smaller gap is of use, at least 0: the search ends when there can be no larger one, or when one along the given
/// axis is at least half of what there can be.
Gap find_gap(const ConvexShape &first, const ConvexShape &second, const Vector3 &axis, double least);
} // namespace ode_predictive_space

#endif
