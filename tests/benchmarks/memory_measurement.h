// How much memory a space takes, and whether that stays so.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_MEMORY_MEASUREMENT_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_MEMORY_MEASUREMENT_H

#include "demos/runs/spaces.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

namespace ode_predictive_space::benchmarks
{
/// What a space holds at one moment.
struct MemorySample
{
    int tick = 0;
    /// As the predictive space itself counts; 0 for others.
    std::int64_t counted = 0;
    /// As the allocator counts: the program with the scene in this space less the program with the scene alone. Negative
    /// noise is possible for a space that keeps nothing.
    std::int64_t allocated = 0;
    /// The same in the middle of dSpaceCollide(): what the space takes only while it works is in it.
    std::int64_t at_work = 0;
    /// Pairs that a predictive space does not test now because their shapes cannot touch yet; 0 for others.
    std::int64_t postponed = 0;
    std::int64_t near = 0; ///< pairs in the near set of a predictive space; 0 for others
};

struct MemoryResult
{
    worlds::SpaceKind space{};
    worlds::WorldSpec spec{};
    std::vector<MemorySample> samples{}; ///< at equal distances, the last one at the end
};

/// Runs a scene and looks at the memory so many times.
///
/// @param progress called now and then with the number of ticks done.
MemoryResult measure_memory(worlds::SpaceKind kind, const worlds::WorldSpec &spec, int ticks, int samples,
                            const std::function<void(int)> &progress = {});

/// The largest sample of the second half over the largest of the first half without its first tenth, in which a space still
/// fills up. 1 or less: it does not grow.
///
/// @param member &MemorySample::counted or &MemorySample::allocated
double memory_growth(const MemoryResult &result, std::int64_t MemorySample::*member);

/// What the measure of shapes takes for each near pair, postponed or not, beyond what the measure of boxes takes for it: in bytes
/// as the spaces count. What it takes for each geom is left out by comparing two scenes of about as many geoms, of which one has
/// few near pairs. Not a number when that one has as many.
struct ShapeMemory
{
    MemoryResult by_boxes, by_shapes; ///< of the same scene

    std::int64_t extra() const { return by_shapes.samples.back().counted - by_boxes.samples.back().counted; }
    std::int64_t near() const { return by_shapes.samples.back().near; }
};
double bytes_per_near_pair(const ShapeMemory &few_pairs, const ShapeMemory &many_pairs);

/// {scene, n, space, seed, ticks, bytes_per_geom, allocated_bytes_per_geom, at_work_bytes_per_geom, postponed, samples}: of the
/// last sample; bytes_per_geom is null for spaces that do not count.
nlohmann::json memory_record(const MemoryResult &result);
} // namespace ode_predictive_space::benchmarks

#endif
