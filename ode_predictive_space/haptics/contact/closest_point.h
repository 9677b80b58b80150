// The point nearest to the tool that no plane forbids.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CLOSEST_POINT_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CLOSEST_POINT_H

#include "ode_predictive_space/haptics/device.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// The yield of a surface that no push moves.
constexpr double rigid_yield = 1e-6;

/// The constraint of a touch: the proxy must not be behind the plane.
struct ConstraintPlane
{
    Vector3 normal = Vector3::UnitZ(); ///< of length 1, towards where the proxy may be
    double depth = 0;                  ///< m; how far the tool is behind it
    double yield = rigid_yield;        ///< > 0; compliance per share: see find_yielding_place()
    double share = 0;                  ///< m, >= 0; the part of the lift along its normal
    double most = 0;                   ///< m; the yield times the largest share: find_yielding_place() sets it
};

bool are_finite(const std::vector<ConstraintPlane> &planes);

double deepest_of(const std::vector<ConstraintPlane> &planes);

Vector3 lift_of(const std::vector<ConstraintPlane> &planes);

/// Finds the shortest x, from the tool, with normal . x >= depth for all planes, and writes it as the sum of share * normal: at
/// most three shares are above zero, none is below. With one plane alone, its share is its depth, exactly. The tolerance is
/// 1e-9 of the deepest plane, or 1e-6 where normals are too close to dependent for that.
/// @return false, with the depths as shares, when no such point exists, when it is more than a hundred times as far as the
///         deepest plane (between nearly opposite planes, x grows without bound), or when the input is not finite, so that
///         later checks find it.
bool find_closest_point(std::vector<ConstraintPlane> &planes);
} // namespace ode_predictive_space::haptics

#endif
