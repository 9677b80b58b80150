// Instructions per tick of scenes in spaces, and two runs of them side by side.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_COUNTS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_COUNTS_H

#include <cstdint>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
/// What was counted: one scene in one space.
struct CountedScene
{
    std::string scene;
    int objects = 0;
    std::uint64_t seed = 1;
    int warm_up_ticks = 0;
    int ticks = 0; ///< that the instructions are of
    std::string space;
};

/// {count: kind, scene, n, seed, warm_up_ticks, ticks, space}
nlohmann::json record_of(const CountedScene &counted, const std::string &kind);

/// For the tables: name and number of objects.
std::string title_of(const CountedScene &counted);

/// In the caches that callgrind simulates.
struct CacheMisses
{
    double first_level = 0; ///< of data
    double last_level = 0;  ///< of data
};

struct Count : CountedScene
{
    double collide = 0; ///< instructions per tick in dSpaceCollide(), with a callback that only notes the pair
    double notices = 0; ///< instructions per tick in what ODE tells the space of geoms that move
    /// Of a world with a short life: creation and destruction of its space, spread over its ticks.
    std::optional<double> life = {};
    std::optional<double> bytes_per_geom = {}; ///< of such a world; none where they are not known
    std::optional<CacheMisses> misses = {};    ///< per tick, of collide and notices
    std::uint64_t pairs = 0;
    std::string pair_hash = {}; ///< of all ticks, with the warm-up; in hexadecimal digits

    double sum() const { return collide + notices + life.value_or(0); }
};

/// {count: "instructions", scene, n, seed, warm_up_ticks, ticks, space, collide, notices, sum, pairs, pair_hash} and, where they
/// were counted, {life, bytes_per_geom} and {first_level_misses, last_level_misses}
nlohmann::json record_of(const Count &count);

/// The counts in what a run has written.
///
/// @throws nlohmann::json::exception when it does not hold a list of records.
std::vector<Count> counts_in(const nlohmann::json &records);

/// The fewest instructions of ODE's own spaces in this scene; null when none was counted.
const Count *best_of_ode(const std::vector<Count> &counts, const Count &in_scene_of);

/// One scene in one space, in two runs.
struct CountPair
{
    Count before;
    Count now;

    double ratio() const { return now.sum() / before.sum(); } ///< < 1: fewer instructions than before
    bool same_pairs() const { return before.pairs == now.pairs && before.pair_hash == now.pair_hash; }
};

/// The counts that both runs have.
///
/// @throws std::runtime_error when there are none, or when two are of other ticks or of another seed.
std::vector<CountPair> in_both(const std::vector<Count> &before, const std::vector<Count> &now);

struct RatioSummary
{
    double geometric_mean = 1;
    double largest = 1;
    std::string largest_in; ///< the scene and its size
};

/// @param pairs at least one.
RatioSummary summary_of(const std::vector<CountPair> &pairs);

/// A table of counts, scene by scene.
void print(std::ostream &out, const std::vector<Count> &counts);

/// A table of ratios and, for each space, their geometric mean and the largest of them.
void print(std::ostream &out, const std::vector<CountPair> &pairs);
} // namespace ode_predictive_space::benchmarks

#endif
