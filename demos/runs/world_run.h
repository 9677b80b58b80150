#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_WORLD_RUN_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_WORLD_RUN_H

#include "demos/runs/spaces.h"
#include "demos/runs/statistics.h"
#include "demos/worlds/world.h"

#include <chrono>
#include <memory>
#include <vector>

namespace ode_predictive_space::worlds
{
using Clock = std::chrono::steady_clock;

inline double seconds_between(Clock::time_point begin, Clock::time_point end)
{
    return std::chrono::duration<double>(end - begin).count();
}

/// The time that reading the clock adds to an interval between two readings, in seconds (the median of many).
double clock_overhead();

/// A contender with its own copy of a scene.
class WorldRun
{
public:
    WorldRun(SpaceKind kind, const WorldFactory &factory);
    WorldRun(std::unique_ptr<Contender> contender, const WorldFactory &factory);

    ~WorldRun();

    /// Makes ticks: motion, dSpaceCollide(), contacts.
    void turn(int ticks);

    /// Forget the times so far, but not the pairs: the ticks so far were warm-up.
    void start_measuring();

    /// In place of dSpaceCollide(), calls dSpaceCollide2() for the first `queries` of the scene's queries in each tick, as a
    /// program that needs only what is near some geoms. Times and pairs below are then those of these calls.
    void ask_only(std::size_t queries) { queries_ = queries; }

    /// In each tick, calls dCollide() for all reported pairs right after dSpaceCollide(), and measures that: the narrow phase
    /// of a program. The scene, which calls it for the pairs in its own order, does so in any case.
    void measure_contacts() { measuring_contacts_ = true; }

    const Contender &contender() const { return *contender_; }
    const std::string &name() const { return contender_->name(); }

    /// Duration of each dSpaceCollide() since start_measuring(), in microseconds.
    const std::vector<double> &collide_times() const { return collide_times_; }

    /// Duration of each whole tick since start_measuring(), in microseconds: motion, step of the world, collide, contacts.
    const std::vector<double> &tick_times() const { return tick_times_; }

    /// With measure_contacts(): duration of the dCollide() calls of each tick since start_measuring(), in microseconds.
    const std::vector<double> &contact_times() const { return contact_times_; }
    std::uint64_t calls() const { return calls_; } ///< of dCollide() since start_measuring()

    /// With measure_contacts(): number of pairs with contacts, summed over the ticks since start_measuring().
    std::uint64_t touching() const { return touching_; }

    /// With measure_contacts(): one hash per tick, of the pairs with contacts.
    const std::vector<std::uint64_t> &touching_hashes() const { return touching_hashes_; }

    std::size_t ticks() const { return tick_hashes_.size(); }            ///< since the beginning
    std::size_t measured_ticks() const { return collide_times_.size(); } ///< since start_measuring()
    std::uint64_t pairs() const { return pairs_; }                       ///< summed over ticks()
    std::uint64_t contacts() const { return contacts_; }                 ///< summed over ticks()
    std::uint64_t pair_hash() const;                                     ///< of all ticks()

    /// Pairs that were reported although their boxes were apart, and are not counted in pairs(). They are searched only in the
    /// sweep-and-prune space; for the others every reported pair is counted.
    std::uint64_t false_pairs() const { return false_pairs_; }

    /// One hash per tick, to find the tick at which two runs diverge.
    const std::vector<std::uint64_t> &tick_hashes() const { return tick_hashes_; }

private:
    void make_tick();
    void collide();
    void find_contacts();
    void note_touching(const std::vector<IndexPair> &pairs);

    std::unique_ptr<Contender> contender_; // before the scene, whose geoms are in its space
    std::unique_ptr<World> scene_;
    PairList list_;
    std::size_t queries_ = 0; ///< 0: dSpaceCollide()
    bool measuring_contacts_ = false;
    double clock_overhead_;
    std::uint64_t pairs_ = 0;
    std::uint64_t contacts_ = 0;
    std::uint64_t false_pairs_ = 0;
    std::vector<double> collide_times_;
    std::vector<double> tick_times_;
    std::vector<double> contact_times_;
    std::vector<IndexPair> touching_pairs_; // in this tick
    std::uint64_t calls_ = 0;
    std::uint64_t touching_ = 0;
    std::vector<std::uint64_t> touching_hashes_;
    std::vector<std::uint64_t> tick_hashes_;
};

using WorldRuns = std::vector<std::unique_ptr<WorldRun>>;

WorldRuns make_runs(const std::vector<SpaceKind> &kinds, const WorldFactory &factory);

/// Makes `ticks` ticks in each run, in alternating blocks of some hundred; each round begins with another run. The load, clock
/// frequency and temperature then affect all runs alike, and a run finds its data in the cache as it would alone.
void run_by_turns(const WorldRuns &runs, int ticks);

/// Number of the first tick in which the exact contenders did not all report the same pairs, from 0 on; -1 when there is none.
/// The runs have made the same number of ticks.
int first_difference(const WorldRuns &runs);

/// The first tick in which the pairs with contacts differ, among all contenders, exact or not: all with measure_contacts().
int first_difference_of_contacts(const WorldRuns &runs);
} // namespace ode_predictive_space::worlds

#endif
