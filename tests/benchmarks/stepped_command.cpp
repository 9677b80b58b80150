// predictive_bench stepped: scenes whose world is stepped between two ticks, as that of a program is.

#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/scene_choice.h"
#include "tests/benchmarks/span_table.h"
#include "tests/benchmarks/windows.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <set>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

struct SteppedCase
{
    std::string scene;
    int objects;
    int warm_up_ticks;
    int ticks;
};

constexpr double seconds_of_settling = 0.5;

const std::vector<SteppedCase> &stepped_cases()
{
    static const std::vector<SteppedCase> all = {
        {"gas", 100, 200, 10000},     {"gas", 1000, 100, 3000},     {"gas", 10000, 100, 1000},
        {"game", 100, 200, 10000},    {"game", 1000, 100, 3000},    {"game", 10000, 100, 1000},
        {"pile", 100, 100, 3000},     {"pile", 500, 100, 1000},     {"settling", 500, 0, 400}, // it has settled by then
        {"stack", 1000, 100, 1200}, // the ball is thrown every 400 ticks
        {"terrain", 1000, 100, 1000}, {"teleport", 1000, 50, 1000}, {"dart", 1000, 100, 3000},
        {"dart", 10000, 100, 1000},   {"ask", 10000, 100, 1000},
    };
    return all;
}

std::string describe_stepped()
{
    std::string text =
        "Mean, median and percentiles are of dSpaceCollide() alone, whose callback only notes the pair. Between two\n"
        "calls there are the narrow phase, contact joints, dWorldQuickStep() and the notices of what moved; the\n"
        "whole tick is all of it. In microseconds. Scenes:\n";
    std::set<std::string> told;
    for (const SteppedCase &one : stepped_cases())
    {
        if (told.insert(one.scene).second)
        {
            text.append("  ").append(one.scene).append(": ").append(stepped_world(one.scene).text).append("\n");
        }
    }
    return text;
}

std::vector<std::string> stepped_contenders()
{
    std::vector<std::string> names = {"predictive-box", "predictive-sphere"};
    names.insert(names.end(), ode_spaces().begin(), ode_spaces().end());
    return names;
}

Plan plan_of(const SteppedCase &one, const Options &options, Findings &findings)
{
    const WorldSpec spec{one.scene, one.objects, options.seed};
    Plan plan = plan_for(spec, fast_enough(stepped_contenders(), spec, findings), one.ticks, options);
    plan.warm_up_ticks = one.warm_up_ticks;
    plan.seconds_each = unlimited;
    plan.weigh = false;
    plan.queries = one.scene == "ask" ? asking_spheres : 0;
    plan.world = stepped_world(one.scene).name;
    return plan;
}

void measure_case(const SteppedCase &one, const Options &options, Findings &findings)
{
    const Plan plan = plan_of(one, options, findings);
    const Comparison comparison = compare_single_ticks(plan, findings);
    const Span span = {"stepped", one.scene, 0, 0, plan.queries == 0 ? "dSpaceCollide()" : "20 dSpaceCollide2()"};
    if (one.scene != "settling")
    {
        show(span, comparison, findings);
        return;
    }
    const auto per_window = static_cast<std::size_t>(std::lround(seconds_of_settling / stepped_world(one.scene).step));
    double begin = 0;
    for (const Comparison &window : windows_of(comparison, per_window))
    {
        show({span.table, one.scene, begin, begin + seconds_of_settling, span.calls}, window, findings);
        begin += seconds_of_settling;
    }
}

class SteppedCommand : public Command
{
public:
    std::string name() const override { return "stepped"; }
    std::string description() const override
    {
        return "Scenes whose world is stepped between two ticks: what a program meets";
    }

    void add_options(CLI::App &command) override
    {
        command.footer(describe_stepped());
        command.add_option("--scenes", scenes_, "Scenes, or scenes and sizes, separated by commas: stack,gas:1000")
            ->delimiter(',');
    }

    void measure(const Options &options, Findings &findings) override
    {
        for (const SteppedCase &one : chosen(stepped_cases(), scenes_))
        {
            if (options.objects.value_or(one.objects) == one.objects)
            {
                measure_case(one, options, findings);
            }
        }
    }

private:
    std::vector<std::string> scenes_;
};
} // namespace

std::unique_ptr<Command> make_stepped_command()
{
    return std::make_unique<SteppedCommand>();
}
} // namespace ode_predictive_space::benchmarks
