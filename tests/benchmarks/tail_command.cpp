// predictive_bench tail: the worst ticks, not the mean.

#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/histogram.h"

#include "demos/runs/table.h"

#include <algorithm>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

constexpr int tail_objects = 10000;
constexpr int tail_ticks = 5000;
constexpr int tail_warm_up = 500;

/// All do the same in each tick: what the machine does meanwhile lengthens other ticks of each run, what the space does the
/// same ones of all.
constexpr int runs = 3;

void shorten(std::vector<double> &times, const std::vector<double> &others)
{
    std::transform(times.begin(), times.end(), others.begin(), times.begin(),
                   [](double one, double other) { return std::min(one, other); });
}

/// Of each tick the shortest time, this run's and that of further ones.
std::vector<double> shortest_times(const Result &first, Plan plan, Findings &findings)
{
    plan.contenders = {first.name};
    std::vector<double> shortest = first.times;
    for (int run = 1; run < runs; ++run)
    {
        shorten(shortest, compare_single_ticks(plan, findings).results.front().times);
    }
    return shortest;
}

void show(const Result &result, const WorldSpec &spec, Findings &findings)
{
    const Histogram histogram = histogram_of(result.times);
    std::cout << result.name << '\n';
    print(std::cout, histogram);
    std::cout << '\n';
    findings.record({{"histogram", "tail"},
                     {"scene", spec.name},
                     {"n", spec.objects},
                     {"space", result.name},
                     {"seed", spec.seed},
                     {"edges_us", histogram.edges},
                     {"counts", histogram.counts}});
}

Comparison compare_and_show(const Plan &plan, Findings &findings)
{
    Comparison comparison = compare_single_ticks(plan, findings);
    print(std::cout, comparison);
    record(comparison, findings);
    for (const Result &result : comparison.results)
    {
        show(result, plan.spec, findings);
    }
    return comparison;
}

void require(const std::vector<double> &ticks, const WorldSpec &spec, const std::string &which, Findings &findings)
{
    const Statistics times = summarise(ticks);
    const std::string where = spec.name + " " + grouped(static_cast<std::uint64_t>(spec.objects)) + ", ";
    findings.require(
        {"P9", where + "p99.9 over the median" + which, times.p999 / times.median, Requirement::at_most, 2, "x"});
    findings.require(
        {"P9", where + "maximum over the median" + which, times.max / times.median, Requirement::at_most, 5, "x"});
}

class TailCommand : public Command
{
public:
    std::string name() const override { return "tail"; }
    std::string description() const override { return "The worst ticks: a histogram of their times"; }

    void measure(const Options &options, Findings &findings) override
    {
        const WorldSpec spec{"gas", options.objects.value_or(tail_objects), options.seed};
        Plan plan = plan_for(spec, {"predictive-box"}, tail_ticks, options);
        plan.ticks = options.ticks.value_or(tail_ticks); // also when quick: rare ticks need many
        plan.warm_up_ticks = tail_warm_up;
        plan.seconds_each = unlimited;
        const Comparison comparison = compare_and_show(plan, findings);
        if (const Result *ours = comparison.find("predictive-box"))
        {
            require(ours->times, plan.spec, "", findings);
            require(shortest_times(*ours, plan, findings), plan.spec, ", of each tick the shortest of three runs",
                    findings);
        }
        if (options.spaces.empty())
        {
            // What it does hardly differs from tick to tick: its worst ticks are the machine's.
            plan.contenders = {"floor"};
            compare_and_show(plan, findings);
        }
    }
};
} // namespace

std::unique_ptr<Command> make_tail_command()
{
    return std::make_unique<TailCommand>();
}
} // namespace ode_predictive_space::benchmarks
