// What a geom's matrix is. ODE takes it for a rotation, and keeps it one only while it steps the body: dGeomSetRotation() and
// dGeomSetQuaternion() store what they are given, dBodySetRotation() leaves the second row as given where it is not orthogonal to
// the first, and dGeomRaySet() overwrites the third column of the body's matrix, if the ray has no offset from its body.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_ROTATION_H
#define ODE_PREDICTIVE_SPACE_SPACE_ROTATION_H

#include <array>
#include <cmath>

#include <ode/common.h>

#include "ode_predictive_space/broadphase/base/simd.h"
#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// Is no row of the matrix longer than 1, but for round-off? A point at a distance d from the origin then stays within d along
/// each axis, so that a sphere that holds a geom in every orientation is as wide as its bounding box. False for NaN.
inline bool keeps_within_sphere(const dMatrix3 R)
{
    constexpr float round_off = sizeof(dReal) == sizeof(double) ? 1e-6f : 1e-5f;
    const Float4 x = Float4::nearest_of_stored(R, 4), y = Float4::nearest_of_stored(R + 1, 4),
                 z = Float4::nearest_of_stored(R + 2, 4);
    return (((x * x + y * y) + z * z <= Float4::all(1 + round_off)).bits() & three_lanes) == three_lanes;
}

/// The sum of what the products of the columns of a matrix are off those of a rotation; NaN when an entry is.
inline double skew_of(const dMatrix3 R)
{
    const std::array<Vector3, 3> columns{Vector3(R[0], R[4], R[8]), Vector3(R[1], R[5], R[9]),
                                         Vector3(R[2], R[6], R[10])};
    double skew = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j <= i; ++j)
            skew += std::abs(columns[i].dot(columns[j]) - (i == j ? 1 : 0));
    return skew;
}
/// Beyond this, ODE's colliders find contacts anywhere in the bounding box. (A rotation matrix is integrated and normalised, so
/// it is not exact.)
constexpr double most_skew = sizeof(dReal) == sizeof(double) ? 1e-6 : 1e-5;
} // namespace ode_predictive_space

#endif
