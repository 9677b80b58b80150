// Scenes so small that reading the clock would be a part of what is measured.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_BATCHES_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_BATCHES_H

#include "demos/worlds/world.h"

#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
constexpr int ticks_per_batch = 64;

/// Whether a scene is measured in batches: below some hundreds of objects, and when its motion can be recorded.
bool measured_in_batches(const worlds::WorldSpec &spec);

enum class NearCallback
{
    collect,      ///< the broad phase alone: the callback notes the pair
    find_contacts ///< broad and narrow phase: the callback calls dCollide() for up to eight contacts
};

/// Microseconds per tick of each contender, one figure per batch.
///
/// The motion is recorded batch by batch and replayed to each contender's copy of the scene and, by itself, to one more
/// copy; between two readings of the clock there are the motion, dSpaceCollide() and end_tick() of a whole batch, and the
/// time of the motion by itself is subtracted.
///
/// A space has its costs in two places: in dSpaceCollide(), and in the notices that ODE gives it of each geom that moves. The
/// copy that moves by itself is never collided, so that all its geoms stay dirty and ODE gives its space no notice: what is
/// subtracted is bare motion, the same for all, and a contender's figure holds all that its program pays for having it.
/// (When ticks are timed one by one, notices fall outside the time that is measured, for all alike.)
std::vector<std::vector<double>> measure_batches(const worlds::WorldFactory &factory,
                                                 const std::vector<std::string> &contenders, int ticks,
                                                 NearCallback callback);
} // namespace ode_predictive_space::benchmarks

#endif
