#include "ode_predictive_space/surface/triangle.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

namespace ode_predictive_space
{
namespace
{
constexpr double flattest_squared_sine = 1e-20; // a flatter triangle is treated as its edges

NearestOnTriangle nearest_on_edge(const Vector3 &point, const TriangleCorners &corners, int edge)
{
    const int next = (edge + 1) % 3;
    const Vector3 along = corners[next] - corners[edge];
    const double square = along.squaredNorm();
    const double part = square > 0 ? std::clamp((point - corners[edge]).dot(along) / square, 0.0, 1.0) : 0;

    NearestOnTriangle nearest;
    nearest.part = part > 0 && part < 1 ? TrianglePart::edge : TrianglePart::corner;
    nearest.index = part < 1 ? edge : next;
    nearest.point = part < 1 ? corners[edge] + part * along : corners[next];
    nearest.squared_distance = (point - nearest.point).squaredNorm();
    return nearest;
}

/// Is the point outside the face across this edge, seen along the normal?
bool is_beyond_edge(const Vector3 &point, const TriangleCorners &corners, const Vector3 &normal, int edge)
{
    const Vector3 along = corners[(edge + 1) % 3] - corners[edge];
    return normal.cross(along).dot(point - corners[edge]) < 0;
}
} // namespace

NearestOnTriangle nearest_on_triangle(const Vector3 &point, const TriangleCorners &corners)
{
    const Vector3 first = corners[1] - corners[0];
    const Vector3 second = corners[2] - corners[0];
    const Vector3 normal = first.cross(second);
    const double square = normal.squaredNorm();
    const bool has_face = square > flattest_squared_sine * first.squaredNorm() * second.squaredNorm();

    // An edge of a face can be nearest only if the point is beyond it.
    NearestOnTriangle nearest;
    nearest.squared_distance = std::numeric_limits<double>::infinity();
    bool is_over_face = has_face;
    for (int edge = 0; edge < 3; ++edge)
    {
        if (has_face && !is_beyond_edge(point, corners, normal, edge))
        {
            continue;
        }
        is_over_face = false;
        const NearestOnTriangle on_edge = nearest_on_edge(point, corners, edge);
        if (!(on_edge.squared_distance >= nearest.squared_distance))
        {
            nearest = on_edge;
        }
    }
    if (is_over_face)
    {
        const double height = normal.dot(point - corners[0]);
        nearest.point = point - normal * (height / square);
        nearest.squared_distance = height * height / square;
    }
    return nearest;
}
} // namespace ode_predictive_space
