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

/// Durations of ticks in microseconds, and numbers, since start_measuring().
struct Measured
{
    std::vector<double> collide_times; ///< of each dSpaceCollide()
    std::vector<double> tick_times;    ///< of each whole tick: motion, step of the world, collide, contacts
    std::vector<double> contact_times; ///< with measure_contacts(): of the dCollide() calls of each tick
    std::uint64_t calls = 0;           ///< with measure_contacts(): of dCollide()
    std::uint64_t touching = 0;        ///< with measure_contacts(): pairs with contacts, summed over the ticks
};

/// Summed over all ticks since the beginning, or one value per tick.
struct Reported
{
    std::uint64_t pairs = 0;
    std::uint64_t contacts = 0;
    /// Pairs that were reported although their boxes were apart, and are not counted in `pairs`. They are searched only in the
    /// sweep-and-prune space; for the others every reported pair is counted.
    std::uint64_t false_pairs = 0;
    std::vector<std::uint64_t> tick_hashes;     ///< of the pairs
    std::vector<std::uint64_t> touching_hashes; ///< with measure_contacts(): of the pairs with contacts

    std::size_t ticks() const { return tick_hashes.size(); }
};

/// A contender with its own copy of a scene.
class WorldRun
{
public:
    WorldRun(std::unique_ptr<Contender> contender, const WorldFactory &factory);

    ~WorldRun();

    /// Makes ticks: motion, dSpaceCollide(), contacts.
    void turn(int ticks);

    /// Forget the times so far, but not the pairs: the ticks so far were warm-up.
    void start_measuring() { measured_ = {}; }

    /// In place of dSpaceCollide(), calls dSpaceCollide2() for the first `queries` of the scene's queries in each tick, as a
    /// program that needs only what is near some geoms. Times and pairs are then those of these calls.
    void ask_only(std::size_t queries) { queries_ = queries; }

    /// In each tick, calls dCollide() for all reported pairs right after dSpaceCollide(), and measures that: the narrow phase
    /// of a program. The scene, which calls it for the pairs in its own order, does so in any case.
    void measure_contacts() { measuring_contacts_ = true; }

    const Contender &contender() const { return *contender_; }
    const std::string &name() const { return contender_->name(); }
    const Measured &measured() const { return measured_; }
    const Reported &reported() const { return reported_; }

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
    double clock_overhead_ = clock_overhead();
    std::vector<IndexPair> touching_pairs_; // in this tick
    Measured measured_;
    Reported reported_;
};

using WorldRuns = std::vector<std::unique_ptr<WorldRun>>;

WorldRuns make_runs(const std::vector<SpaceKind> &kinds, const WorldFactory &factory);

/// Makes `ticks` ticks in each run, in alternating blocks of some hundred; each round begins with another run. The load, clock
/// frequency and temperature then affect all runs alike, and a run finds its data in the cache as it would alone.
void run_by_turns(const WorldRuns &runs, int ticks);

/// The first tick, counted from 0, in which two exact contenders reported different pairs; -1 if they never did.
/// @pre the runs have made the same number of ticks.
int first_difference(const WorldRuns &runs);

/// As above, for the pairs with contacts and all contenders. @pre measure_contacts() was called for each run.
int first_difference_of_contacts(const WorldRuns &runs);
} // namespace ode_predictive_space::worlds

#endif
