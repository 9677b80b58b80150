#include "ode_predictive_space/haptics/contact/triangle.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double smallest_squared_sine = 1e-20; // below, a triangle is its edges

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

/// Whether the point lies above or below the face, and not beside it.
bool is_over_face(const Vector3 &point, const TriangleCorners &corners, const Vector3 &normal)
{
    for (int i = 0; i < 3; ++i)
    {
        const Vector3 along = corners[(i + 1) % 3] - corners[i];
        if (normal.cross(along).dot(point - corners[i]) < 0)
        {
            return false;
        }
    }
    return true;
}
} // namespace

NearestOnTriangle nearest_on_triangle(const Vector3 &point, const TriangleCorners &corners)
{
    const Vector3 first = corners[1] - corners[0];
    const Vector3 second = corners[2] - corners[0];
    const Vector3 normal = first.cross(second);
    const double square = normal.squaredNorm();
    if (square > smallest_squared_sine * first.squaredNorm() * second.squaredNorm() &&
        is_over_face(point, corners, normal))
    {
        NearestOnTriangle nearest;
        const double height = normal.dot(point - corners[0]);
        nearest.point = point - normal * (height / square);
        nearest.squared_distance = height * height / square;
        return nearest;
    }
    NearestOnTriangle nearest = nearest_on_edge(point, corners, 0);
    for (int edge = 1; edge < 3; ++edge)
    {
        const NearestOnTriangle other = nearest_on_edge(point, corners, edge);
        if (other.squared_distance < nearest.squared_distance)
        {
            nearest = other;
        }
    }
    return nearest;
}
} // namespace ode_predictive_space::haptics
