// One scene, several contenders: the same motion for each, their pairs compared, their times measured.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_COMPARISON_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_COMPARISON_H

#include "demos/runs/world_run.h"
#include "tests/benchmarks/findings.h"
#include "tests/benchmarks/options.h"

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
struct Plan
{
    worlds::WorldSpec spec;
    std::vector<std::string> contenders;
    int ticks = 1000;        ///< to measure
    int warm_up_ticks = 100; ///< before that; their pairs are compared, too
    double seconds_each =
        worlds::unlimited; ///< a contender that has used up so many makes no more ticks, see run_by_turns()
    bool check = false;    ///< check the predictive spaces by brute force after every tick
    std::string
        world{}; ///< the world of this name, tick by tick; empty: the one of spec.name, in batches where it is small
    std::size_t queries = 0; ///< not 0: instead of dSpaceCollide(), dSpaceCollide2() for so many queries of the scene
    bool contacts = false;   ///< measure the dCollide() calls for the reported pairs, too
    bool weigh = false; ///< find out what memory contenders need that do not tell: this takes one more copy of each
};

/// What one contender did.
struct Result
{
    std::string name;
    worlds::Family family = worlds::Family::reference;
    bool exact = true;
    std::vector<double> times;       ///< microseconds per dSpaceCollide(), or of each batch the mean
    std::vector<double> clock_times; ///< microseconds per dSpaceCollide(), each timed by itself in any case
    std::vector<double> tick_times;  ///< microseconds per whole tick: motion, dSpaceCollide(), contacts
    /// With Plan::contacts: microseconds per dSpaceCollide() and dCollide() for its pairs, or of each batch the mean.
    std::vector<double> both_times;
    double calls_per_tick = 0;       ///< of dCollide(), with Plan::contacts
    double touching_per_tick = 0;    ///< pairs with contacts, with Plan::contacts
    std::uint64_t touching_hash = 0; ///< of the pairs with contacts of all ticks, with Plan::contacts
    std::size_t ticks = 0;           ///< all, with the warm-up: those that the pairs are of
    std::uint64_t pairs = 0;
    std::uint64_t pair_hash = 0;
    std::uint64_t false_pairs = 0;
    std::uint64_t contacts = 0;
    double bytes_per_geom = std::numeric_limits<double>::quiet_NaN(); ///< not a number: not known

    double mean() const { return worlds::summarise(times).mean; }
    double mean_tick() const { return worlds::summarise(tick_times).mean; }
    double mean_of_both() const { return worlds::summarise(both_times).mean; }
};

struct Comparison
{
    worlds::WorldSpec spec;
    bool in_batches = false; ///< times are means of batches, see measure_batches()
    std::vector<Result> results;

    /// The result of this contender; null when it did not take part.
    const Result *find(const std::string &name) const;

    /// The fastest of ODE's own spaces by its mean; null when none took part.
    const Result *best_of_ode() const;

    /// The same by the mean of whole ticks.
    const Result *best_of_ode_by_ticks() const;

    /// The same by the mean of dSpaceCollide() and dCollide().
    const Result *best_of_ode_with_contacts() const;

    static constexpr std::size_t least_common_ticks = 20;

    /// How many times as long as ours the other's mean tick takes. Where both have been timed tick by tick, this is over the
    /// ticks that both have, if they are not too few: a contender that was stopped early is not compared with what happened
    /// later.
    double ratio(const Result &other, const Result &ours) const;
};

/// Make the comparison. Contenders that cannot take part are left out, with a note. When contenders that must agree do not,
/// or a predictive space does not pass its check, it says so on the standard error and lets the findings fail.
Comparison compare(const Plan &plan, Findings &findings);

/// The same, printed and recorded; but a scene that has been compared so before, with at least these contenders, is not
/// compared again: that comparison is the result, whatever else the plan says.
std::shared_ptr<const Comparison> compare_once(const Plan &plan, Findings &findings);

/// A comparison without the times that need batches: of ticks that are timed one by one, in scenes of any size.
Comparison compare_single_ticks(const Plan &plan, Findings &findings);

/// A plan for this scene as the options have it, with what a subcommand takes where they say nothing.
///
/// @param ticks what is enough; a fifth of it when quick.
Plan plan_for(const worlds::WorldSpec &spec, const std::vector<std::string> &contenders, int ticks,
              const Options &options);

/// Those of the contenders that are not too slow to be waited for with so many objects; for each of the others a note.
std::vector<std::string> fast_enough(const std::vector<std::string> &contenders, const worlds::WorldSpec &spec,
                                     Findings &findings);

/// The names of ODE's own spaces.
const std::vector<std::string> &ode_spaces();

/// A table of a comparison, with a head line.
void print(std::ostream &out, const Comparison &comparison);

/// One record per contender: {scene, n, space, seed, ticks, measured_ticks, in_batches, mean_us, median_us, p99_us,
/// p999_us, max_us, pairs, pair_hash, false_pairs, contacts, bytes_per_geom, best_ode_ratio}. The times are over the
/// measured ticks; pairs and hash over all; bytes_per_geom and best_ode_ratio are null where they are not known.
void record(const Comparison &comparison, Findings &findings);
} // namespace ode_predictive_space::benchmarks

#endif
