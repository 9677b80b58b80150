// What it costs to ask a space what is near a probe or along a ray.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_QUERY_MEASUREMENT_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_QUERY_MEASUREMENT_H

#include "demos/runs/spaces.h"

#include <functional>
#include <nlohmann/json.hpp>

namespace ode_predictive_space::benchmarks
{
struct QuerySettings
{
    int objects = 10000;
    int ticks = 1000; ///< to measure
    std::uint64_t seed = 1;
    std::vector<worlds::SpaceKind> spaces;
    /// Whether dSpaceCollide() is called in each tick before the queries, untimed, as most programs do. Without it, the first
    /// query of a tick also pays for the motion since the last one.
    bool collide_first = true;
    bool still = false; ///< whether nothing moves but what asks
    bool check = false; ///< check the predictive spaces by brute force after every tick
};

/// The queries of one kind in one space.
struct QuerySeries
{
    std::vector<double> times{}; ///< of all queries of a tick together, microseconds
    std::uint64_t pairs = 0;     ///< that the space reported, over all ticks with the warm-up
    std::uint64_t pair_hash = 0;
};

struct QueryResult
{
    worlds::SpaceKind space{};
    bool exact = true; ///< whether it is to report the same pairs as the others
    bool valid = true; ///< passed its checks
    QuerySeries spheres{};
    QuerySeries rays{};
};

/// The scene "query" in these spaces, which alternate: in each tick dSpaceCollide2(probe, space) for 20 spheres, then for 20 rays.
///
/// @param progress called now and then with the number of ticks done.
std::vector<QueryResult> measure_queries(const QuerySettings &settings, const std::function<void(int)> &progress = {});

/// Whether all exact spaces reported the same pairs.
bool same_pairs(const std::vector<QueryResult> &results);

/// Whether all predictive spaces passed their check; true when none was asked for.
bool all_valid(const std::vector<QueryResult> &results);

/// How many times as long as predictive-box the fastest of these spaces takes, mean against mean.
///
/// @param series &QueryResult::spheres or &QueryResult::rays
/// @return 0 when predictive-box or all of these were not measured.
double query_ratio(const std::vector<QueryResult> &results, const std::vector<worlds::SpaceKind> &others,
                   QuerySeries QueryResult::*series);

/// Two records per space, with "what": "spheres" or "rays".
nlohmann::json query_records(const std::vector<QueryResult> &results, const QuerySettings &settings);
} // namespace ode_predictive_space::benchmarks

#endif
