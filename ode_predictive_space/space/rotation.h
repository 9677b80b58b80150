// What a geom's matrix is. ODE takes it for a rotation, and keeps it one only while it steps the body: dGeomSetRotation() and
// dGeomSetQuaternion() store what they are given, dBodySetRotation() leaves the second row as given where it is not orthogonal to
// the first, and dGeomRaySet() overwrites the third column of the body's matrix, if the ray has no offset from its body.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_ROTATION_H
#define ODE_PREDICTIVE_SPACE_SPACE_ROTATION_H

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <ode/common.h>

#include "ode_predictive_space/broadphase/base/simd.h"
#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// Of the products of rows of a rotation that is stored in ODE's precision.
constexpr float round_off = sizeof(dReal) == sizeof(double) ? 1e-6f : 1e-5f;

/// The columns of a matrix in single precision.
struct Columns
{
    Float4 x, y, z;

    explicit Columns(const dMatrix3 R)
        : x(Float4::nearest_of_stored(R, 4)), y(Float4::nearest_of_stored(R + 1, 4)),
          z(Float4::nearest_of_stored(R + 2, 4))
    {}
};

/// Is no row of the matrix longer than 1, but for round-off? A point at a distance d from the origin then stays within d along
/// each axis, so that a sphere that holds a geom in every orientation is as wide as its bounding box. False for NaN.
inline Mask4 short_rows(const Columns &R)
{
    return (R.x * R.x + R.y * R.y) + R.z * R.z <= Float4::all(1 + round_off);
}
inline bool in_three_lanes(Mask4 mask)
{
    return (mask.bits() & three_lanes) == three_lanes;
}
inline bool keeps_within_sphere(const dMatrix3 R)
{
    return in_three_lanes(short_rows(Columns(R)));
}

/// Is it the identity, as ODE stores it? Most offsets are not turned, and this is compared bit by bit, which costs a third of the
/// products below.
inline bool is_identity(const dMatrix3 R)
{
    using Bits = std::conditional_t<sizeof(dReal) == sizeof(double), std::uint64_t, std::uint32_t>;
    const auto differing_bits = [R](std::size_t entry, dReal expected) {
        Bits found, wanted;
        std::memcpy(&found, R + entry, sizeof found);
        std::memcpy(&wanted, &expected, sizeof wanted);
        return found ^ wanted;
    };
    Bits differing = 0;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            differing |= differing_bits(4 * row + column, row == column ? 1 : 0);
    return differing == 0;
}

/// Does the matrix make no vector longer, but for round-off? The rows of its product with a matrix of short rows are short, too.
/// (Entries of short rows can be multiplied in single precision.)
inline bool lengthens_nothing(const dMatrix3 matrix)
{
    const Columns R(matrix);
    if (!in_three_lanes(short_rows(R)))
        return false;
    const Float4 products = (R.x * R.x.rotated() + R.y * R.y.rotated()) + R.z * R.z.rotated();
    return in_three_lanes(abs(products) <= Float4::all(round_off));
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
