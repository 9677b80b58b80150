// The event schedule: one event that comes in and goes out again, the wheel being as full as it stays.

#include "ode_predictive_space/broadphase/event_wheel.h"
#include "tests/broadphase/support/random.h"

#include <benchmark/benchmark.h>

namespace ode_predictive_space::micro
{
namespace
{
constexpr std::size_t delays = 4096;

/// @param state its first argument: the longest time that an event waits, in ticks; beyond 1,024 the wheel turns more than
///        once. The second: events in the wheel.
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
