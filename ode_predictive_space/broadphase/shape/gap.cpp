#include "ode_predictive_space/broadphase/shape/gap.h"

#include <algorithm>
#include <array>
#include <optional>

#include <Eigen/LU>

#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
namespace
{
// Finds the weights of the point of a line, plane or space that is nearest to the origin.
template <int Dimensions, typename Points, typename Weights> bool solve(const Points &points, Weights &weights)
{
    Eigen::Matrix<double, 3, Dimensions> sides;
    for (int i = 0; i < Dimensions; ++i)
        sides.col(i) = points[static_cast<std::size_t>(i + 1)] - points[0];
    Eigen::Matrix<double, Dimensions, Dimensions> inverse = Eigen::Matrix<double, Dimensions, Dimensions>::Zero();
    bool invertible = false;
    const Eigen::Matrix<double, Dimensions, Dimensions> squares = sides.transpose() * sides;
    squares.computeInverseWithCheck(inverse, invertible, 0);
    const Eigen::Matrix<double, Dimensions, 1> found = inverse * (sides.transpose() * -points[0]);
    weights[0] = 1 - found.sum();
    for (int i = 0; i < Dimensions; ++i)
        weights[static_cast<std::size_t>(i + 1)] = found[i];
    return invertible && found.allFinite();
}

// Converges to a convex shape's nearest point to the origin, if each added corner is the farthest one against the direction of
// point(). Unused corners are dropped, so that at most four remain. (P. Wolfe: Finding the nearest point in a polytope, 1976)
class NearestPoint
{
public:
    explicit NearestPoint(const Vector3 &first) : points_{first}, weights_{1}, point_(first) {}

    const Vector3 &point() const { return point_; }

    // @return false if the point comes no nearer: up to rounding, it is the nearest one.
    bool add(const Vector3 &corner);

private:
    static constexpr int most = 4;
    using Weights = std::array<double, most>;

    bool find_affine(Weights &weights) const;
    void move_towards(const Weights &weights);
    void drop_unused();
    Vector3 weighted() const;

    std::array<Vector3, most> points_;
    Weights weights_{};
    int count_ = 1;
    Vector3 point_;
};

bool NearestPoint::add(const Vector3 &corner)
{
    if (count_ == most)
        return false; // the origin is inside
    const double before = point_.squaredNorm();
    points_[static_cast<std::size_t>(count_)] = corner;
    weights_[static_cast<std::size_t>(count_++)] = 0;
    Weights affine{};
    while (count_ > 1 && find_affine(affine))
    {
        const bool within =
            std::all_of(affine.begin(), affine.begin() + count_, [](double weight) { return weight > 0; });
        move_towards(affine);
        if (within)
            break;
        drop_unused();
    }
    point_ = weighted();
    return point_.squaredNorm() < before;
}

// Some weights may be negative: the point is in the line, plane or space through all points, but maybe outside their hull.
bool NearestPoint::find_affine(Weights &weights) const
{
    return count_ == 2   ? solve<1>(points_, weights)
           : count_ == 3 ? solve<2>(points_, weights)
                         : solve<3>(points_, weights);
}

// Moves until a weight would become negative.
void NearestPoint::move_towards(const Weights &weights)
{
    double part = 1;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
        if (weights[i] <= 0 && weights[i] != weights_[i])
            part = std::min(part, weights_[i] / (weights_[i] - weights[i]));
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
    {
        const double moved = weights_[i] + part * (weights[i] - weights_[i]);
        weights_[i] = weights[i] <= 0 && moved <= 1e-12 ? 0 : moved;
    }
}

void NearestPoint::drop_unused()
{
    std::size_t left = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
        if (weights_[i] > 0)
        {
            points_[left] = points_[i];
            weights_[left++] = weights_[i];
        }
    count_ = static_cast<int>(left);
}

Vector3 NearestPoint::weighted() const
{
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i)
        sum += weights_[i] * points_[i];
    return sum;
}

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
