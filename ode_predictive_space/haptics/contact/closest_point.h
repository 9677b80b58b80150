// The point nearest to the tool that no plane forbids.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CLOSEST_POINT_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CLOSEST_POINT_H

#include "ode_predictive_space/haptics/device.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// The yield of what no push moves.
constexpr double rigid_yield = 1e-6;

/// What a touch forbids to the proxy: all behind a plane.
struct ConstraintPlane
{
    Vector3 normal = Vector3::UnitZ(); ///< of length 1, towards where the proxy may be
    double depth = 0;                  ///< m; how far the tool is behind it
    double yield = rigid_yield;        ///< > 0; how far it gives way per share: see find_yielding_place()
    double share = 0;                  ///< m, >= 0; how far it lifts the proxy off the tool, along its normal
    double most = 0;                   ///< m; the yield times the largest share: find_yielding_place() sets it
};

bool are_finite(const std::vector<ConstraintPlane> &planes);

/// m; how far the tool is behind the plane that it is farthest behind; 0 when it is behind none.
double deepest_of(const std::vector<ConstraintPlane> &planes);

/// m; from the tool to the proxy.
Vector3 lift_of(const std::vector<ConstraintPlane> &planes);

/// Finds the shortest x, from the tool, with normal . x >= depth for all planes, and writes it as the sum of share * normal:
/// at most three shares are above zero, none is below. With one plane alone, its share is its depth, exactly.
///
/// False, and the shares are the depths, when there is no such point, or only one that is more than a hundred times as
/// far as the deepest plane: between two nearly opposite planes, x grows without bounds. Likewise when something is not
/// finite, so that checks for it still find it.
///
/// Planes that miss their depth by 1e-9 of the deepest one are taken as kept; by 1e-6 where normals are so nearly dependent that rounding
/// leaves no such point.
bool find_closest_point(std::vector<ConstraintPlane> &planes);
} // namespace ode_predictive_space::haptics

#endif
