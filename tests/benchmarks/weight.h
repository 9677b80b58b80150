// What memory a contender needs.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_WEIGHT_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_WEIGHT_H

#include "demos/worlds/world.h"

#include <cstddef>
#include <optional>
#include <string>

namespace ode_predictive_space::benchmarks
{
/// Bytes that the program has from its heap.
std::size_t heap_in_use();

/// Bytes that a predictive space holds, as it tells; none for other spaces.
std::optional<std::size_t> told_bytes(dSpaceID space);

/// Bytes per geom that a contender holds between ticks, besides the geoms themselves: what the heap grows by when it is made
/// with a copy of the scene, without what it grows by for the scene alone, and what its first dSpaceCollide() calls add.
///
/// @return not a number for those that hold nothing between ticks but need memory in between (hash), or are no way to find
///         pairs (brute, floor).
double bytes_per_geom(const std::string &contender, const worlds::WorldFactory &factory);
} // namespace ode_predictive_space::benchmarks

#endif
