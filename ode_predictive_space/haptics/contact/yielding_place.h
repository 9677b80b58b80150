// The place of the proxy between surfaces that yield.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_YIELDING_PLACE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_YIELDING_PLACE_H

#include "ode_predictive_space/haptics/contact/closest_point.h"

namespace ode_predictive_space::haptics
{
/// The compliance of a surface per share, for the force of a tick.
/// @param stiffness N/m. @param mobility 1/kg; of the surface along its normal. @param seconds of the tick.
double yield_of(double stiffness, double mobility, double seconds);

/// Finds the shares that hold the proxy off the tool, whatever the planes: the solution of a quadratic program,
///     minimise   1/2 |sum of share normal|^2 + 1/2 sum of yield share^2 - sum of depth share      over share >= 0,
/// which has one solution and changes continuously with depths and normals, so forces do not jump when planes begin or cease to
/// carry. Its dual has three unknowns, the place x of the proxy, so its cost is in proportion to the number of planes:
///     minimise   1/2 |x|^2 + sum of max(0, depth - normal . x)^2 / (2 yield),      share = max(0, depth - normal . x) / yield.
/// The method of multipliers takes back the depths by which the planes have yielded, in two more passes. A plane alone gets its
/// depth as its share, but for a part of (yield / (1 + yield))^3. Shares that act against each other alone stay below 0.8 depth
/// / yield (1.2 for yields below 0.04), or below the depth of the deepest plane where that is more. The share of a surface that
/// no push moves has no bound. When something is not finite, the shares are the depths, so that checks for it still find it.
void find_yielding_place(std::vector<ConstraintPlane> &planes);
} // namespace ode_predictive_space::haptics

#endif
