#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_WORLD_RUN_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_WORLD_RUN_H

#include "demos/worlds/world.h"
#include "tests/benchmarks/contenders/contender.h"

#include <chrono>

namespace ode_predictive_space::benchmarks
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

/// Since the beginning.
struct Reported
{
    std::uint64_t pairs = 0;                    ///< summed over the ticks
    std::vector<std::uint64_t> tick_hashes;     ///< of the pairs of each tick
    std::vector<std::uint64_t> touching_hashes; ///< with measure_contacts(): of the pairs with contacts
};

/// A contender with its own copy of a world.
class WorldRun
{
public:
    WorldRun(std::unique_ptr<Contender> contender, const worlds::WorldFactory &factory);

    ~WorldRun();

    /// Makes ticks: motion, dSpaceCollide(), contacts.
    void turn(int ticks);

    /// Forget the times so far, but not the pairs: the ticks so far were warm-up.
    void start_measuring() { measured_ = {}; }

    /// In each tick, calls dCollide() for all reported pairs right after dSpaceCollide(), and measures that: the narrow phase
    /// of a program. The world, which calls it for the pairs in its own order, does so in any case.
    void measure_contacts() { measuring_contacts_ = true; }

    const Contender &contender() const { return *contender_; }
    const Measured &measured() const { return measured_; }
    const Reported &reported() const { return reported_; }

private:
    void make_tick();
    void find_contacts();
    void note_touching(const std::vector<worlds::IndexPair> &pairs);

    std::unique_ptr<Contender> contender_; // before the world, whose geoms are in its space
    std::unique_ptr<worlds::World> world_;
    worlds::PairList list_;
    bool measuring_contacts_ = false;
    double clock_overhead_ = clock_overhead();
    std::vector<worlds::IndexPair> touching_pairs_; // in this tick
    Measured measured_;
    Reported reported_;
};
} // namespace ode_predictive_space::benchmarks

#endif
