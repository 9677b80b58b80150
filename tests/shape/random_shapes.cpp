#include "tests/shape/random_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_predictive_space
{
namespace
{
double log_between(ShapeMaker &maker, double low, double high)
{
    return std::exp(maker.between(std::log(low), std::log(high)));
}

// The point of the shape that is nearest to `point`.
Vector3 nearest_of(const ConvexShape &shape, const Vector3 &point)
{
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

ConvexShape ShapeMaker::shape(Solid solid)
{
    const auto side = [this] { return log_between(*this, 0.01, 0.5); };
    ConvexShape shape;
    shape.kind = solid == Solid::cylinder ? ShapeKind::cylinder : ShapeKind::rounded;
    shape.group = shape.partners = 1;
    for (std::size_t i = 0; i < 3; ++i)
        shape.axes[i] = Vector3::Unit(static_cast<Eigen::Index>(i));
    if (solid == Solid::plane)
    {
        shape.kind = ShapeKind::half_space;
        shape.size = std::numeric_limits<double>::infinity();
        return shape;
    }
    if (solid == Solid::box)
        shape.half_sides = Vector3(side(), side(), side());
    else
        shape.radius = side();
    if (solid == Solid::capsule || solid == Solid::cylinder)
        shape.half_sides[2] = side();
    shape.size = 2 * (solid == Solid::box        ? shape.half_sides.minCoeff()
                      : solid == Solid::cylinder ? std::min(shape.radius, shape.half_sides[2])
                                                 : shape.radius);
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
