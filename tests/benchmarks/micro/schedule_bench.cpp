// The schedule: the time of proximity of a candidate pair, and an event that comes in and goes out again, the wheel being as
// full as it stays.

#include "ode_predictive_space/broadphase/schedule/event_wheel.h"
#include "ode_predictive_space/broadphase/schedule/pair_proximity.h"
#include "tests/broadphase/support/proxies.h"

#include <benchmark/benchmark.h>

namespace ode_predictive_space::micro
{
namespace
{
constexpr std::size_t delays = 4096;
constexpr ProxyId objects = 128; // they stay in the first-level cache

/// As the tick and all questions compute it, the first object's half of the work included.
void pair_proximity(benchmark::State &state)
{
    Random random(1);
    ProxyStore proxies;
    for (ProxyId id = 0; id < objects; ++id)
    {
        add_random_proxy(proxies, random, 0.5, 0);
    }
    ProxyId next = 0;
    while (state.KeepRunning())
    {
        const ProxyId first = next++ % objects, second = next % objects;
        benchmark::DoNotOptimize(PairProximity(proxies, first, 0, ProximityTest::box).to(second));
    }
}
BENCHMARK(pair_proximity);

/// @param state its first argument: the longest time that an event waits, in ticks; beyond two turns of 64 it waits in a
///        coarse bucket first. The second: events in the wheel.
void schedule_and_take(benchmark::State &state)
{
    const auto longest = static_cast<std::size_t>(state.range(0));
    // As many as come due come in: the mean delay is half the longest.
    const std::size_t per_tick = 1 + 2 * static_cast<std::size_t>(state.range(1)) / longest;
    Random random(1);
    std::vector<Tick> due_in;
    for (std::size_t i = 0; i < delays; ++i)
    {
        due_in.push_back(1 + static_cast<Tick>(random.index(longest)));
    }
    EventWheel wheel;
    wheel.restart(0);
    std::vector<Event> due;
    Tick now = 0;
    std::size_t next = 0;
    const auto tick = [&] {
        for (std::size_t i = 0; i < per_tick; ++i)
        {
            wheel.schedule(now + due_in[next++ % delays], {1, 2, 0, 0});
        }
        due.clear();
        wheel.advance(++now, due);
        benchmark::DoNotOptimize(due.data());
    };
    for (std::size_t i = 0; i < longest; ++i)
    {
        tick();
    }
    while (state.KeepRunning())
    {
        tick();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(per_tick));
}
BENCHMARK(schedule_and_take)->ArgNames({"longest", "events"})->ArgsProduct({{64, 512, 4096}, {1000, 100000}});
} // namespace
} // namespace ode_predictive_space::micro
