// predictive_bench worlds: worlds as programs have them, whole ticks.

#include "demos/worlds/world.h"
#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/scene_choice.h"
#include "tests/benchmarks/span_table.h"
#include "tests/benchmarks/windows.h"

#include "demos/runs/table.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

struct WorldCase
{
    std::string scene;
    int objects;
    int warm_up_ticks;
    int ticks;
};

constexpr double seconds_per_window = 0.5;

const std::vector<WorldCase> &worlds_to_measure()
{
    static const std::vector<WorldCase> all = {
        {"floor", 100, 100, 2000},
        {"floor", 500, 100, 1000},
        {"floor", 2000, 50, 300},
        {"floor_50", 500, 100, 1000},
        {"ragdolls", 20, 100, 1000},
        {"chain", 1, 100, 5000},
        {"shelves", 1000, 50, 500},
        {"shelves", 10000, 50, 200},
        {"shelves_mesh", 1000, 50, 500},
        {"shelves_mesh", 10000, 50, 200},
        {"heap", 100, 0, 600},
        {"heap", 500, 0, 400},
        {"heap", 2000, 0, 400},
        {"heap_50", 500, 0, 400},
        {"drones", 300, 50, 1000},
        {"drones", 1000, 50, 500},
        {"room", 1000, 300, 500},
        {"hills", 1000, 300, 500},
        {"city", 100, 50, 500},
        {"rain", 1000, 50, 600},
        {"frames_0", 1000, 100, 600},
        {"frames_20", 1000, 100, 600},
        {"frames_50", 1000, 100, 600},
        {"frames_80", 1000, 100, 600},
        {"frames_set_0", 1000, 100, 600},
        {"frames_set_20", 1000, 100, 600},
        {"frames_set_50", 1000, 100, 600},
        {"frames_set_80", 1000, 100, 600},
        {"many", 17, 0, 100 * ticks_of_life},
        {"nested", 22, 50, 1000},
        {"nested_empty", 100, 10, 500},
        {"lidar", 1000, 5, 50},
        {"lidar_nested", 1000, 5, 50},
        {"moon", 200, 100, 1000},
    };
    return all;
}

std::string describe_worlds()
{
    std::string text =
        "Mean, median and percentiles are of what a program calls for its pairs; the whole tick is that, the\n"
        "narrow phase, contact joints and the step of the world. In microseconds. A heap is reported by half\n"
        "seconds from its drop on. Worlds of n objects:\n";
    for (const std::string &name : world_names(Group::program))
    {
        text.append("  ").append(name).append(": ").append(world_named(name).text).append("\n");
    }
    return text;
}

std::vector<std::string> world_contenders()
{
    std::vector<std::string> names = {"predictive-box", "predictive-sphere", "predictive-shape"};
    names.insert(names.end(), ode_spaces().begin(), ode_spaces().end());
    return names;
}

/// Logarithms of ratios of several worlds.
class MeanRatio
{
public:
    void add(double ratio)
    {
        if (std::isfinite(ratio) && ratio > 0)
        {
            logarithms_ += std::log(ratio);
            ++count_;
        }
    }
    bool is_known() const { return count_ > 0; }
    double geometric_mean() const { return std::exp(logarithms_ / count_); }

private:
    double logarithms_ = 0;
    int count_ = 0;
};

class WorldsCommand : public Command
{
public:
    std::string name() const override { return "worlds"; }
    std::string description() const override
    {
        return "Worlds as programs have them, stepped with contacts: whole ticks";
    }

    void add_options(CLI::App &command) override
    {
        command.footer(describe_worlds());
        command.add_option("--scenes", scenes_, "Worlds, or worlds and sizes, separated by commas: floor,heap:500")
            ->delimiter(',');
    }

    void measure(const Options &options, Findings &findings) override
    {
        MeanRatio collide, whole;
        for (const WorldCase &one : chosen(worlds_to_measure(), scenes_))
        {
            if (options.objects.value_or(one.objects) == one.objects)
            {
                const Comparison comparison = measure_case(one, options, findings);
                collide.add(collide_ratio(comparison, "predictive-box"));
                whole.add(tick_ratio(comparison, "predictive-box"));
            }
        }
        if (collide.is_known())
        {
            std::cout << "Best ODE space / predictive-box, geometric mean: collide "
                      << fixed(collide.geometric_mean(), 2) << ", whole ticks " << fixed(whole.geometric_mean(), 2)
                      << "\n";
            findings.record({{"table", "worlds"},
                             {"scene", "all"},
                             {"best_ode_ratio", collide.geometric_mean()},
                             {"best_ode_ratio_of_wholes", whole.geometric_mean()}});
        }
    }

private:
    static Comparison measure_case(const WorldCase &one, const Options &options, Findings &findings)
    {
        const WorldSpec spec{one.scene, one.objects, options.seed};
        Plan plan = plan_for(spec, fast_enough(world_contenders(), spec, findings), one.ticks, options);
        plan.warm_up_ticks = one.warm_up_ticks;
        plan.seconds_each = unlimited;
        plan.weigh = false;
        Comparison comparison = compare_single_ticks(plan, findings);
        show({"worlds", one.scene}, comparison, findings);
        if (one.scene == "heap")
        {
            show_windows(comparison, world_named(one.scene).step, findings);
        }
        return comparison;
    }

    static void show_windows(const Comparison &comparison, double tick_seconds, Findings &findings)
    {
        const auto per_window = static_cast<std::size_t>(std::lround(seconds_per_window / tick_seconds));
        double begin = 0;
        for (const Comparison &window : windows_of(comparison, per_window))
        {
            show({"worlds", comparison.spec.name, begin, begin + seconds_per_window}, window, findings);
            begin += seconds_per_window;
        }
    }

    std::vector<std::string> scenes_;
};
} // namespace

std::unique_ptr<Command> make_worlds_command()
{
    return std::make_unique<WorldsCommand>();
}
} // namespace ode_predictive_space::benchmarks
