#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_PAIRS_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_PAIRS_H

#include <cstdint>
#include <utility>
#include <vector>

#include <ode/common.h>

namespace ode_predictive_space::preload
{
using Pair = std::pair<dGeomID, dGeomID>;

/// The space whose pairs dSpaceCollide2(first, second) asks for; 0 when neither is a space.
dSpaceID asked_space(dGeomID first, dGeomID second);

/// Puts pairs, and the two geoms of each, into an order that depends on their classes, bounding boxes and bits alone.
/// @return a hash of them all, the same in every run in which the geoms of the pairs are in the same places.
std::uint64_t put_in_order(std::vector<Pair> &pairs);
} // namespace ode_predictive_space::preload

#endif
