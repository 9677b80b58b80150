#include "ode_predictive_space/broadphase/shape/gap.h"

#include <optional>

#include "ode_predictive_space/broadphase/shape/nearest_point.h"
#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
namespace
{
constexpr int steps = 9; // maximum number of steps of the search

float work_of_axis(const ConvexShape &first, const ConvexShape &second)
{
    return first.work_of_reach() + second.work_of_reach();
}

// The point of the Minkowski difference of both cores, second minus first, that is farthest against the direction.
Vector3 nearest_along(const Vector3 &direction, const ConvexShape &first, const ConvexShape &second)
{
    return (second.centre + second.farthest_of_core(-direction)) - (first.centre + first.farthest_of_core(direction));
}

Gap gap_to_half_space(const ConvexShape &half_space, const ConvexShape &other)
{
    if (other.kind == ShapeKind::half_space)
        return {};
    const Vector3 &out = half_space.axes[0];
    const double length = out.dot(other.centre - half_space.centre) - other.reach(-out);
    return {length - rounding(half_space) - rounding(other), out, other.work_of_reach()};
}

// Steps of GJK (Gilbert, Johnson, Keerthi 1988) towards the point of the Minkowski difference that is closest to the origin.
// The direction of each intermediate point is an axis to test.
void approach_closest(const ConvexShape &first, const ConvexShape &second, Vector3 towards, double least, Gap &largest)
{
    const double around = first.core_distance() + second.core_distance();
    const double rounded = rounding(first) + rounding(second);
    std::optional<NearestPoint> nearest;
    for (int i = 0; i < steps; ++i)
    {
        const Vector3 corner = nearest_along(towards, first, second);
        const double length = towards.norm();
        if (length > 0)
            largest.improve(
                {towards.dot(corner) / length - around - rounded, towards / length, work_of_axis(first, second)});
        if (!nearest)
            nearest.emplace(corner);
        else if (!nearest->add(corner))
            return;
        towards = nearest->point();
        const double distance = towards.norm() - around;
        if (!(distance > least) || largest.length >= tuning::near_enough * distance)
            return;
    }
}

} // namespace

double rounding(const ConvexShape &shape)
{
    constexpr double units = 32 * std::numeric_limits<double>::epsilon();
    return units * (shape.centre.lpNorm<1>() + shape.half_sides.lpNorm<1>() + shape.radius);
}

Gap gap_along(const Vector3 &direction, const ConvexShape &first, const ConvexShape &second)
{
    if (first.kind == ShapeKind::half_space)
        return gap_to_half_space(first, second);
    if (second.kind == ShapeKind::half_space)
    {
        const Gap gap = gap_to_half_space(second, first);
        return {gap.length, -gap.axis, gap.work};
    }
    const Vector3 axis = direction / direction.norm();
    const double length = axis.dot(second.centre - first.centre) - first.reach(axis) - second.reach(-axis);
    return {length - rounding(first) - rounding(second), axis, work_of_axis(first, second)};
}

Gap find_gap(const ConvexShape &first, const ConvexShape &second, const Vector3 &axis, double least)
{
    if (!judged_by_shape(first, second) || first.kind == ShapeKind::terrain || second.kind == ShapeKind::terrain)
        return {};
    if (first.blunt_beside & second.group)
        return find_gap(first.blunt(), second, axis, least);
    if (second.blunt_beside & first.group)
        return find_gap(first, second.blunt(), axis, least);
    if (first.kind == ShapeKind::half_space || second.kind == ShapeKind::half_space)
        return gap_along(axis, first, second);
    Gap largest;
    if (axis.squaredNorm() > 0)
        largest = gap_along(axis, first, second);
    if (largest.length > least)
        return largest;
    approach_closest(first, second, second.centre - first.centre, least, largest);
    return largest;
}
} // namespace ode_predictive_space
