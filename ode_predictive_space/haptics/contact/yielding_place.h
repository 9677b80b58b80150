// The place of the proxy between surfaces that yield.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_YIELDING_PLACE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_YIELDING_PLACE_H

#include "ode_predictive_space/haptics/device.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// A plane that holds the proxy off the tool, and gives way to the force by which it does.
struct YieldingPlane
{
    Vector3 normal = Vector3::UnitZ(); ///< of length 1, towards where the proxy may be
    double depth = 0;                  ///< m; how far the tool is behind it
    double yield = 0;                  ///< > 0; how far it gives way per share
    double share = 0;                  ///< m, >= 0; how far it lifts the proxy off the tool, along its normal
};

/// Finds the shares that hold the proxy off the tool, whatever the planes: the solution of a quadratic program,
///
///     minimise   1/2 |sum of share normal|^2 + 1/2 sum of yield share^2 - sum of depth share      over share >= 0,
///
/// which has one solution and changes continuously with depths and normals, so forces do not jump when planes begin or cease to carry.
/// Its dual has three unknowns, the place x of the proxy, so its cost is in proportion to the number of planes:
///
///     minimise   1/2 |x|^2 + sum of max(0, depth - normal . x)^2 / (2 yield),      share = max(0, depth - normal . x) / yield.
///
/// The method of multipliers takes back what the planes have given way, in two more passes. A plane alone gets its depth as its share,
/// but for a part of (yield / (1 + yield))^3. Shares that act against each other alone stay below 3 depth / yield.
///
/// The shares are the depths when something is not finite, so that checks for it still find it.
void find_yielding_place(std::vector<YieldingPlane> &planes);
} // namespace ode_predictive_space::haptics

#endif
