// Checks of a geom's matrix. ODE treats it as a rotation, but keeps it one only while it steps the body: dGeomSetRotation() and
// dGeomSetQuaternion() store any values, dBodySetRotation() keeps a second row that is not orthogonal to the first, and
// dGeomRaySet() overwrites the third column of the body's matrix if the ray has no offset from its body.

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
/// Upper bound of the round-off in products of rows of a rotation in ODE's precision.
constexpr float round_off = sizeof(dReal) == sizeof(double) ? 1e-6f : 1e-5f;

struct Columns
{
    Float4 x, y, z;

    explicit Columns(const dMatrix3 R)
        : x(Float4::nearest_of_stored(R, 4)), y(Float4::nearest_of_stored(R + 1, 4)),
          z(Float4::nearest_of_stored(R + 2, 4))
    {}
};

/// Per lane: is the row no longer than 1, but for round-off? A point at distance d from the origin then stays within d along
/// that axis, so the cube around a sphere that holds the geom in all orientations contains its bounding box. False for NaN.
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

/// Compares bit by bit, which costs a third of lengthens_nothing(). Most offsets are not turned.
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

/// Does the matrix make no vector longer, but for round-off? Its product with a matrix of short rows then has short rows, too.
/// (Entries of short rows can be multiplied in single precision.)
inline bool lengthens_nothing(const dMatrix3 matrix)
{
    const Columns R(matrix);
    if (!in_three_lanes(short_rows(R)))
        return false;
    const Float4 products = (R.x * R.x.rotated() + R.y * R.y.rotated()) + R.z * R.z.rotated();
    return in_three_lanes(abs(products) <= Float4::all(round_off));
}

/// Sum of the differences between products of columns and those of a rotation; NaN if an entry is.
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
/// With more skew, ODE's colliders may find contacts anywhere in the bounding box. (Integrated rotations are not exact.)
constexpr double most_skew = sizeof(dReal) == sizeof(double) ? 1e-6 : 1e-5;
} // namespace ode_predictive_space

#endif
