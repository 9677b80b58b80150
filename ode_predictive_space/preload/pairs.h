// Pairs of geoms, and which of them a space has to report.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_PAIRS_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_PAIRS_H

#include <cstdint>
#include <utility>
#include <vector>

#include <ode/common.h>

namespace ode_predictive_space::preload
{
using Pair = std::pair<dGeomID, dGeomID>;

/// Not on the same body, and the bits of one want the other.
bool may_collide(dGeomID first, dGeomID second);

/// Enabled, and not of zero size.
bool is_enabled(dGeomID geom);

/// Their bounding boxes overlap or touch, and neither denies it. As in ODE, what is not a number overlaps everything.
bool boxes_overlap(dGeomID first, dGeomID second);

/// What dSpaceCollide(space) has to report: every pair once, found by looking at all of them, in no order.
std::vector<Pair> expected_pairs(dSpaceID space);

/// What dSpaceCollide2(first, second) has to report.
std::vector<Pair> expected_pairs(dGeomID first, dGeomID second);

/// The space whose pairs dSpaceCollide2(first, second) asks for; 0 when neither is a space.
dSpaceID asked_space(dGeomID first, dGeomID second);

/// A number that tells a geom from others by its class, bounding box and bits, the same in every run in which the geom is
/// in the same place.
std::uint64_t fingerprint(dGeomID geom);

/// Puts pairs, and the two geoms of each, into the order of their fingerprints.
///
/// @return a hash of them all.
std::uint64_t put_in_order(std::vector<Pair> &pairs);
} // namespace ode_predictive_space::preload

#endif
