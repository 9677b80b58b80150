// predictive_bench whole: what dSpaceCollide() does not show. A space is told of each move while the scene moves, and the
// predictive space does a part of its work then.

#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"

#include "demos/runs/table.h"

#include <algorithm>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
constexpr int whole_ticks = 1000;

std::vector<worlds::WorldSpec> usual_scenes()
{
    return {{"gas", 1000}, {"gas", 10000}, {"game", 1000}, {"game", 10000}, {"pile", 500}, {"stack", 1000}};
}

// A comparison may be one that was made with more.
void report(const Comparison &comparison, const std::vector<std::string> &contenders, Findings &findings)
{
    std::cout << comparison.spec.name
              << ", n = " << worlds::grouped(static_cast<std::uint64_t>(comparison.spec.objects))
              << ": microseconds per tick, in dSpaceCollide() and outside of it\n\n";
    const Result *best = comparison.best_of_ode_by_ticks();
    worlds::Table table({"space", "collide", "the rest", "whole tick", "best ODE / this"});
    for (const Result &result : comparison.results)
    {
        if (std::find(contenders.begin(), contenders.end(), result.name) == contenders.end())
            continue;
        const double whole = result.mean_tick(), collide = worlds::summarise(result.clock_times).mean;
        const double ratio = best != nullptr ? best->mean_tick() / whole : 0;
        table.add({result.name, worlds::fixed(collide, 2), worlds::fixed(whole - collide, 2), worlds::fixed(whole, 2),
                   worlds::fixed(ratio, 2)});
        findings.record({{"table", "whole"},
                         {"scene", comparison.spec.name},
                         {"n", comparison.spec.objects},
                         {"space", result.name},
                         {"collide_us", collide},
                         {"rest_us", whole - collide},
                         {"whole_us", whole},
                         {"best_ode_ratio_of_wholes", ratio}});
    }
    table.print(std::cout);
    std::cout << '\n';
}

class WholeCommand : public Command
{
public:
    std::string name() const override { return "whole"; }
    std::string description() const override
    {
        return "Whole ticks: the motion, with the notices that spaces get of it, and dSpaceCollide()";
    }

    void measure(const Options &options, Findings &findings) override
    {
        for (const worlds::WorldSpec &spec : usual_scenes())
        {
            if (options.objects && spec.objects != *options.objects)
                continue;
            const Plan plan = plan_for(spec, {"predictive-box", "hash", "quadtree", "sap"}, whole_ticks, options);
            report(*compare_once(plan, findings), plan.contenders, findings);
        }
    }
};
} // namespace

std::unique_ptr<Command> make_whole_command()
{
    return std::make_unique<WholeCommand>();
}
} // namespace ode_predictive_space::benchmarks
