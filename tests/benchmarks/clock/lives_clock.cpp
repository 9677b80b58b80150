// Lives of spaces, from the first geom to the last, with very many, very large, very near and very far objects.

#include "demos/worlds/spaces.h"
#include "tests/benchmarks/clock/agreement.h"
#include "tests/benchmarks/clock/clocks.h"
#include "tests/benchmarks/contenders/pair_hash.h"

#include <algorithm>
#include <ctime>
#include <malloc.h>
#include <set>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

struct Life
{
    std::string world;
    int objects;
    int ticks; ///< after the first one
};

const std::vector<Life> &lives()
{
    static const std::vector<Life> all = {
        {"gas", 1000, 200},
        {"gas", 10000, 100},
        {"gas", 100000, 20},
        {"gas", 1000000, 10},
        {"spot", 500, 20},
        {"spot", 2000, 20},
        {"planes", 1000, 100},
        {"planes", 10000, 20},
        {"planes_all", 1000, 20},
        {"planes_all", 10000, 2},
        {"planes_apart", 1000, 100},
        {"planes_apart", 10000, 20},
        {"spaces_in_spaces", 10, 100},
        {"spaces_in_spaces", 100, 100},
        {"spaces_side_by_side", 10, 100},
        {"spaces_side_by_side", 100, 100},
        {"huge", 1000, 200},
        {"huge", 10000, 100},
        {"close", 1000, 200},
        {"close", 4000, 100},
        {"away", 1000, 200},
        {"away", 4000, 100},
        {"far", 1000, 50},
        {"far", 4000, 20},
        {"forwards", 10000, 10},
        {"forwards", 100000, 10},
        {"backwards", 10000, 10},
        {"backwards", 100000, 10},
        {"shuffled", 10000, 10},
        {"shuffled", 100000, 10},
    };
    return all;
}

/// Processor times of this thread, in milliseconds.
struct Costs
{
    double fill = 0;    ///< all geoms created in the space
    double first = 0;   ///< the first collide
    double move = 0;    ///< the motion of a later tick, with the notices to the space, on average
    double collide = 0; ///< the collide of a later tick, on average
    double empty = 0;   ///< all geoms destroyed
    double heap = 0;    ///< heap bytes after the last tick, including the geoms
    std::uint64_t pairs = 0;
    std::uint64_t hash = 0; ///< hash of the pairs after the last tick
};

double heap_in_use()
{
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

double processor_time()
{
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

template <typename Action> double time_of(Action action)
{
    const double before = processor_time();
    action();
    return processor_time() - before;
}

/// Counts pairs without a list, as one tick may have fifty million.
void count_pair(void *costs, dGeomID, dGeomID)
{
    ++static_cast<Costs *>(costs)->pairs;
}

void hash_pair(void *costs, dGeomID first, dGeomID second)
{
    const auto [low, high] = std::minmax({geom_index(first), geom_index(second)});
    static_cast<Costs *>(costs)->hash += hash_pairs({{low, high}});
}

void make_ticks(World &world, dSpaceID space, int ticks, Costs &costs)
{
    costs.first = time_of([&] { world.collide(space, &costs, near_callbacks<&count_pair>); });
    for (int tick = 0; tick < ticks; ++tick)
    {
        costs.move += time_of([&] { world.advance(); }) / ticks;
        costs.pairs = 0;
        costs.collide += time_of([&] { world.collide(space, &costs, near_callbacks<&count_pair>); }) / ticks;
    }
    costs.heap += heap_in_use();
    world.collide(space, &costs, near_callbacks<&hash_pair>);
}

/// @param ticks 0: the geoms are only created and destroyed.
Costs live(const Life &life, const std::string &space_name, int ticks)
{
    Costs costs;
    const WorldFactory factory({life.world, life.objects});
    costs.heap = -heap_in_use();
    const OwnedSpace space(make_space(space_name, factory));
    std::unique_ptr<World> world;
    costs.fill = time_of([&] { world = factory.make(space.get()); });
    if (ticks > 0)
        make_ticks(*world, space.get(), ticks, costs);
    else
        costs.heap += heap_in_use();
    costs.empty = time_of([&] { world.reset(); });
    return costs;
}

void clock_life(benchmark::State &state, const Life &life, const std::string &space)
{
    // A simple space that is never collided keeps only ODE's list of the geoms.
    const double bare = live(life, "simple", 0).heap;
    Costs costs;
    for (auto _ : state)
    {
        costs = live(life, space, life.ticks);
        state.SetIterationTime(1e-3 * costs.collide);
    }
    state.counters["fill_ms"] = costs.fill;
    state.counters["first_ms"] = costs.first;
    state.counters["move_ms"] = costs.move;
    state.counters["empty_ms"] = costs.empty;
    state.counters["bytes_per_object"] = (costs.heap - bare) / life.objects;
    state.counters["pairs"] = static_cast<double>(costs.pairs);
    // Sweep-and-prune rounds its first axis, so far from the origin it reports pairs that are apart.
    if (space != "sap")
        Agreement::all().check(state, "life of " + life.world + "/" + std::to_string(life.objects), costs.hash);
}
} // namespace

void register_lives(Extent extent)
{
    std::set<std::string> known;
    for (Life life : lives())
    {
        if (extent == Extent::brief)
            life = {life.world, std::min(life.objects, brief_objects), 2};
        for (const std::string space : {"simple", "predictive-box", "sap"})
        {
            const std::string name = benchmark_name("life", life.world, life.objects, space);
            if (life.objects > most_objects(space) || !known.insert(name).second)
                continue;
            benchmark::RegisterBenchmark(name.c_str(),
                                         [life, space](benchmark::State &state) { clock_life(state, life, space); })
                ->Iterations(1)
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond);
        }
    }
}
} // namespace ode_predictive_space::benchmarks
