#include "tests/benchmarks/first_tick.h"

#include "tests/benchmarks/contenders/contenders.h"

#include <algorithm>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

struct FirstTicks
{
    Result result;
    PairHash hash;
};

/// @return the hash of the pairs.
std::uint64_t add_first_tick(FirstTicks &ticks, const WorldFactory &factory)
{
    WorldRun run(benchmarks::make_contender(ticks.result.name, factory), factory);
    run.tick();
    ticks.result.family = run.contender().family();
    ticks.result.exact = run.contender().exact();
    ticks.result.times.push_back(run.collide_times().front());
    ++ticks.result.ticks;
    ticks.result.pairs += run.pairs();
    ticks.result.false_pairs += run.false_pairs();
    ticks.result.contacts += run.contacts();
    ticks.hash.add_tick(run.tick_hashes().front());
    return run.tick_hashes().front();
}

void compare_one_copy(std::vector<FirstTicks> &all, const WorldFactory &factory, int copy, Findings &findings)
{
    std::vector<std::uint64_t> hashes(all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const std::size_t next = (i + static_cast<std::size_t>(copy)) % all.size();
        hashes[next] = add_first_tick(all[next], factory);
    }
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        if (all[i].result.exact && all.front().result.exact && hashes[i] != hashes.front())
        {
            std::cerr << "THE CONTENDERS DISAGREE: in the first tick " << all[i].result.name
                      << " did not report the same pairs as " << all.front().result.name << '\n';
            findings.fail(exit_wrong_pairs);
        }
    }
}
} // namespace

Comparison compare_first_ticks(const Plan &plan, int copies, Findings &findings)
{
    std::vector<FirstTicks> all(plan.contenders.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        all[i].result.name = plan.contenders[i];
    }
    for (int copy = 0; copy < copies; ++copy)
    {
        WorldSpec spec = plan.spec;
        spec.seed += static_cast<std::uint64_t>(copy);
        compare_one_copy(all, WorldFactory(spec), copy, findings);
    }
    Comparison comparison;
    comparison.spec = plan.spec;
    for (FirstTicks &ticks : all)
    {
        ticks.result.pair_hash = ticks.hash.value();
        ticks.result.clock_times = ticks.result.times;
        comparison.results.push_back(ticks.result);
    }
    return comparison;
}
} // namespace ode_predictive_space::benchmarks
