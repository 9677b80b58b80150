#ifndef ODE_PREDICTIVE_SPACE_SURFACE_TRIANGLE_H
#define ODE_PREDICTIVE_SPACE_SURFACE_TRIANGLE_H

#include <array>

#include "ode_predictive_space/prediction/path.h"

namespace ode_predictive_space
{
using TriangleCorners = std::array<Vector3, 3>;

enum class TrianglePart
{
    face,
    edge,
    corner
};

struct NearestOnTriangle
{
    Vector3 point = Vector3::Zero();
    double squared_distance = 0;
    TrianglePart part = TrianglePart::face;
    int index = 0; ///< number of the corner or edge; edge i joins corner i and the next one
};

/// Triangles without area are valid, too. Regions: Ericson, Real-Time Collision Detection, 5.1.5.
NearestOnTriangle nearest_on_triangle(const Vector3 &point, const TriangleCorners &corners);
} // namespace ode_predictive_space

#endif
