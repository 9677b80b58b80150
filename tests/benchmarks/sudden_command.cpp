// predictive_bench sudden: the ticks in which a prediction is worth nothing.

#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/first_tick.h"

#include "demos/runs/table.h"
#include "demos/worlds/world.h"

#include <algorithm>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

/// What is measured with so many objects, and how many times as fast as the best of ODE's spaces it is to be.
struct Size
{
    int objects;
    double at_least;
    int ticks;      ///< of teleport
    int explosions; ///< each after 200 ticks
    int copies;     ///< whose first tick is measured
    bool with_slow; ///< the simple and the hash space, too
};

constexpr Size sizes[] = {
    {10, 1, 20000, 50, 500, true},  {30, 1, 20000, 50, 500, true}, {100, 1, 10000, 50, 200, true},
    {1000, 3, 1000, 10, 100, true}, {10000, 5, 200, 3, 8, false},
};

constexpr int quick_explosions = 2;
constexpr int sudden_warm_up = 100;

std::vector<std::string> contenders(const Size &size)
{
    return size.with_slow ? std::vector<std::string>{"predictive-box", "simple", "hash", "quadtree", "sap"}
                          : std::vector<std::string>{"predictive-box", "quadtree", "sap"};
}

std::string where(const std::string &what, const Size &size)
{
    return what + " " + grouped(static_cast<std::uint64_t>(size.objects));
}

void show(const std::string &what, const Size &size, const Comparison &comparison, Findings &findings)
{
    print(std::cout, comparison);
    record(comparison, findings);
    const Result *ours = comparison.find("predictive-box");
    const Result *best = comparison.best_of_ode();
    if (ours != nullptr && best != nullptr)
    {
        findings.require({"P6", where(what, size) + ", best ODE (" + best->name + ") over ours",
                          comparison.ratio(*best, *ours), Requirement::at_least, size.at_least, "x"});
    }
}

/// Of the times of a run only those of the ticks in which all velocities change, and of as many after each.
void keep_explosions(Result &result, int ticks_after)
{
    std::vector<double> kept;
    const std::size_t before = result.ticks - result.clock_times.size();
    for (std::size_t i = 0; i < result.clock_times.size(); ++i)
    {
        if ((before + i + 1) % ticks_between_explosions == 0)
        {
            const auto first = result.clock_times.begin() + static_cast<std::ptrdiff_t>(i);
            const auto last = first + std::min<std::ptrdiff_t>(ticks_after + 1, result.clock_times.end() - first);
            kept.push_back(*std::max_element(first, last));
        }
    }
    result.times = kept;
}

class SuddenCommand : public Command
{
public:
    std::string name() const override { return "sudden"; }
    std::string description() const override
    {
        return "Ticks in which no prediction holds: everything jumps, all velocities change, all is new";
    }

    void measure(const Options &options, Findings &findings) override
    {
        for (const Size &size : sizes)
        {
            if (options.objects.value_or(size.objects) != size.objects)
            {
                continue;
            }
            if (!size.with_slow)
            {
                findings.note(where("sudden", size) + ": without simple and hash, which are far from the best there");
            }
            measure_teleport(size, options, findings);
            measure_explosion(size, options, findings);
            measure_first_tick(size, options, findings);
        }
    }

private:
    static void measure_teleport(const Size &size, const Options &options, Findings &findings)
    {
        const Plan plan = plan_for({"teleport", size.objects}, contenders(size), size.ticks, options);
        show("teleport", size, compare(plan, findings), findings);
    }

    static void measure_explosion(const Size &size, const Options &options, Findings &findings)
    {
        Plan plan = plan_for({"explosion", size.objects}, contenders(size), 0, options);
        const int explosions = options.quick ? std::max(quick_explosions, size.explosions / 5) : size.explosions;
        plan.ticks = explosions * ticks_between_explosions;
        plan.warm_up_ticks = sudden_warm_up;
        plan.seconds_each = unlimited;
        Comparison comparison = compare_single_ticks(plan, findings);
        for (Result &result : comparison.results)
        {
            keep_explosions(result, 0);
        }
        comparison.spec.name = "explosion tick";
        show("explosion tick", size, comparison, findings);
        for (Result &result : comparison.results)
        {
            keep_explosions(result, 9);
        }
        comparison.spec.name = "slowest of ten ticks from an explosion on";
        show("slowest of ten ticks from an explosion on", size, comparison, findings);
    }

    static void measure_first_tick(const Size &size, const Options &options, Findings &findings)
    {
        const Plan plan = plan_for({"gas", size.objects}, contenders(size), 1, options);
        const int copies = options.quick ? std::max(3, size.copies / 5) : size.copies;
        Comparison comparison = compare_first_ticks(plan, copies, findings);
        comparison.spec.name = "first tick of gas";
        show("first tick of gas", size, comparison, findings);
    }
};
} // namespace

std::unique_ptr<Command> make_sudden_command()
{
    return std::make_unique<SuddenCommand>();
}
} // namespace ode_predictive_space::benchmarks
