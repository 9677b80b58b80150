#include "tests/shape/random_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_predictive_space
{
namespace
{
struct PointHull : VertexHull
{
    explicit PointHull(const std::vector<Vector3> &given) : VertexHull(given), points(given)
    {
        for (Vector3 &point : points)
            point -= centre();
    }
    std::vector<Vector3> points;
};

std::vector<Vector3> points_of(const VertexHull &hull)
{
    return static_cast<const PointHull &>(hull).points;
}

double log_between(ShapeMaker &maker, double low, double high)
{
    return std::exp(maker.between(std::log(low), std::log(high)));
}

// The nearest point of a hull, by pairwise Frank-Wolfe steps: each moves weight from the worst of the points that have some to
// the best of all. After any number of steps, the result is a point of the hull.
Vector3 nearest_of_points(const std::vector<Vector3> &points, const Vector3 &point)
{
    std::vector<double> weights(points.size());
    weights[0] = 1;
    Vector3 nearest = points[0];
    for (int step = 0; step < 60; ++step)
    {
        const Vector3 outwards = nearest - point;
        std::size_t best = 0, worst = points.size();
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            if (outwards.dot(points[i]) < outwards.dot(points[best]))
                best = i;
            if (weights[i] > 0 && (worst == points.size() || outwards.dot(points[i]) > outwards.dot(points[worst])))
                worst = i;
        }
        const Vector3 way = points[best] - points[worst];
        constexpr double hardly_nearer = 1e-12;
        if (!(outwards.dot(way) < -hardly_nearer))
            break;
        const double moved = std::min(weights[worst], -outwards.dot(way) / way.squaredNorm());
        weights[worst] -= moved;
        weights[best] += moved;
        nearest += moved * way;
    }
    return nearest;
}

Vector3 nearest_of_hull(const ConvexShape &shape, const Vector3 &point)
{
    Eigen::Matrix3d axes;
    axes << shape.axes[0], shape.axes[1], shape.axes[2];
    return shape.centre + axes * nearest_of_points(points_of(*shape.hull), axes.transpose() * (point - shape.centre));
}

Vector3 nearest_of(const ConvexShape &shape, const Vector3 &point)
{
    if (shape.kind == ShapeKind::hull)
        return nearest_of_hull(shape, point);
    const Vector3 offset = point - shape.centre;
    if (shape.kind == ShapeKind::half_space)
        return point - std::max(0.0, shape.axes[0].dot(offset)) * shape.axes[0];
    if (shape.kind == ShapeKind::cylinder)
    {
        const double along = shape.axes[2].dot(offset), half = shape.half_sides[2];
        const Vector3 across = offset - along * shape.axes[2];
        return shape.centre + std::clamp(along, -half, half) * shape.axes[2] +
               across * std::min(1.0, shape.radius / std::max(across.norm(), 1e-300));
    }
    Vector3 of_box = shape.centre;
    for (Eigen::Index i = 0; i < 3; ++i)
    {
        const Vector3 &axis = shape.axes[static_cast<std::size_t>(i)];
        of_box += std::clamp(axis.dot(offset), -shape.half_sides[i], shape.half_sides[i]) * axis;
    }
    const Vector3 outwards = point - of_box;
    return of_box + outwards * std::min(1.0, shape.radius / std::max(outwards.norm(), 1e-300));
}
} // namespace

Vector3 ShapeMaker::direction()
{
    if (one_in(4))
        return Vector3::Unit(between(0, 2.999)) * (one_in(2) ? 1 : -1);
    for (;;)
    {
        const Vector3 any = vector();
        if (any.squaredNorm() > 0.01 && any.squaredNorm() < 1)
            return any.normalized();
    }
}

Eigen::Matrix3d ShapeMaker::rotation()
{
    const double quarter = std::acos(0.0);
    const double angle = one_in(4) ? quarter * static_cast<int>(between(0, 4)) : between(-4, 4);
    const double slightly = one_in(3) ? log_between(*this, 1e-9, 1e-1) : 0;
    return (Eigen::AngleAxisd(slightly, direction()) * Eigen::AngleAxisd(angle, direction())).toRotationMatrix();
}

ConvexShape ShapeMaker::hull()
{
    const Vector3 sides(log_between(*this, 0.01, 0.5), log_between(*this, 0.01, 0.5), log_between(*this, 0.01, 0.5));
    std::vector<Vector3> points;
    if (one_in(3))
        for (int i = one_in(2) ? 4 : 30; i > 0; --i)
            points.push_back(sides.cwiseProduct(vector()));
    else
        for (int i = 0; i < 8; ++i)
            points.push_back(sides.cwiseProduct(Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    return hull_of(points);
}

ConvexShape ShapeMaker::shape(SolidKind solid)
{
    const auto side = [this] { return log_between(*this, 0.01, 0.5); };
    ConvexShape shape = solid == SolidKind::hull ? hull() : ConvexShape();
    if (solid != SolidKind::hull)
        shape.kind = solid == SolidKind::cylinder ? ShapeKind::cylinder : ShapeKind::rounded;
    shape.group = shape.partners = 1;
    for (std::size_t i = 0; i < 3; ++i)
        shape.axes[i] = Vector3::Unit(static_cast<Eigen::Index>(i));
    if (solid == SolidKind::plane)
    {
        shape.kind = ShapeKind::half_space;
        shape.size = std::numeric_limits<double>::infinity();
        return shape;
    }
    if (solid == SolidKind::hull)
        return shape;
    if (solid == SolidKind::box)
        shape.half_sides = Vector3(side(), side(), side());
    else
        shape.radius = side();
    if (solid == SolidKind::capsule || solid == SolidKind::cylinder)
        shape.half_sides[2] = side();
    shape.size = 2 * (solid == SolidKind::box        ? shape.half_sides.minCoeff()
                      : solid == SolidKind::cylinder ? std::min(shape.radius, shape.half_sides[2])
                                                     : shape.radius);
    return shape;
}

ConvexShape hull_of(const std::vector<Vector3> &points, const std::shared_ptr<TriangleTree> &surface)
{
    const auto hull = std::make_shared<PointHull>(points);
    hull->surface = surface;
    ConvexShape shape;
    shape.kind = ShapeKind::hull;
    shape.group = shape.partners = 1;
    for (std::size_t i = 0; i < 3; ++i)
        shape.axes[i] = Vector3::Unit(static_cast<Eigen::Index>(i));
    shape.hull = hull;
    shape.half_sides = hull->half_sides();
    shape.size = 2 * shape.half_sides.minCoeff();
    shape.centre = hull->centre();
    return shape;
}

ConvexShape moved(const ConvexShape &shape, const Eigen::Matrix3d &turn, const Vector3 &by)
{
    ConvexShape result = shape;
    for (Vector3 &axis : result.axes)
        axis = (turn * axis).normalized();
    result.centre += by;
    return result;
}

double distance_from_above(const ConvexShape &first, const ConvexShape &second, int steps)
{
    Vector3 of_first = first.kind == ShapeKind::half_space ? nearest_of(first, second.centre) : first.centre;
    double distance = std::numeric_limits<double>::infinity();
    for (int i = 0; i < steps; ++i)
    {
        const Vector3 of_second = nearest_of(second, of_first);
        of_first = nearest_of(first, of_second);
        distance = std::min(distance, (of_first - of_second).norm());
    }
    return distance;
}
} // namespace ode_predictive_space
