// predictive_bench stepped: scenes whose world is stepped between two ticks, as that of a program is.

#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/scene_choice.h"
#include "tests/benchmarks/stepped/stepped_scenes.h"
#include "tests/benchmarks/stepped/windows.h"

#include "demos/scenes/pile_scene.h"
#include "demos/scenes/table.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace scenes;

struct Case
{
    std::string scene;
    int objects;
    int warm_up_ticks;
    int ticks;
};

constexpr double seconds_per_window = 0.5;

const std::vector<Case> &cases()
{
    static const std::vector<Case> all = {
        {"gas", 100, 200, 10000},     {"gas", 1000, 100, 3000},     {"gas", 10000, 100, 1000},
        {"game", 100, 200, 10000},    {"game", 1000, 100, 3000},    {"game", 10000, 100, 1000},
        {"pile", 100, 100, 3000},     {"pile", 500, 100, 1000},     {"settling", 500, 0, 400}, // it has settled by then
        {"stack", 1000, 100, 1200}, // the ball is thrown every 400 ticks
        {"terrain", 1000, 100, 1000}, {"teleport", 1000, 50, 1000}, {"dart", 1000, 100, 3000},
        {"dart", 10000, 100, 1000},   {"ask", 10000, 100, 1000},
    };
    return all;
}

std::string describe_all()
{
    std::string text =
        "Mean, median and percentiles are of dSpaceCollide() alone, whose callback only notes the pair. Between two\n"
        "calls there are the narrow phase, contact joints, dWorldQuickStep() and the notices of what moved; the\n"
        "whole tick is all of it. In microseconds. Scenes:\n";
    for (const std::string &name : stepped_scene_names())
    {
        text.append("  ").append(name).append(": ").append(describe_stepped_scene(name)).append("\n");
    }
    return text;
}

std::vector<std::string> contenders()
{
    std::vector<std::string> names = {"predictive-box", "predictive-sphere"};
    names.insert(names.end(), ode_spaces().begin(), ode_spaces().end());
    return names;
}

Plan plan_of(const Case &one, const Options &options, Findings &findings)
{
    const SceneSpec spec = spec_of_stepped_scene(one.scene, one.objects, options.seed);
    Plan plan = plan_for(spec, fast_enough(contenders(), spec, findings), one.ticks, options);
    plan.warm_up_ticks = one.warm_up_ticks;
    plan.seconds_each = unlimited;
    plan.weigh = false;
    plan.queries = queries_of_stepped_scene(one.scene);
    plan.make_scene = [name = one.scene](const SceneFactory &factory, dSpaceID space) {
        return make_stepped_scene(name, factory, space);
    };
    return plan;
}

/// A scene, or a part of it.
struct Span
{
    std::string scene;
    double begin = 0; ///< seconds since the scene began
    double end = 0;   ///< 0: all that was measured

    bool is_window() const { return end > 0; }
};

/// Not a number when there is nothing to compare with.
double quotient(double one, double other)
{
    return other > 0 ? one / other : std::nan("");
}

double collide_ratio(const Comparison &comparison, const Result &result)
{
    const Result *best = comparison.best_of_ode();
    return best != nullptr ? comparison.ratio(*best, result) : std::nan("");
}

double tick_ratio(const Comparison &comparison, const Result &result)
{
    const Result *best = comparison.best_of_ode_by_ticks();
    return best != nullptr ? quotient(best->mean_tick(), result.mean_tick()) : std::nan("");
}

std::string ratio_text(double ratio)
{
    return std::isfinite(ratio) ? fixed(ratio, 2) : "-";
}

nlohmann::json value_if(bool known, double value)
{
    return known ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json ratio_record(double ratio)
{
    return value_if(std::isfinite(ratio), ratio);
}

void print(const Span &span, const Comparison &comparison)
{
    std::cout << span.scene << ", n = " << grouped(static_cast<std::uint64_t>(comparison.spec.objects)) << ", seed "
              << comparison.spec.seed;
    if (span.is_window())
    {
        std::cout << ", " << fixed(span.begin, 1) << " to " << fixed(span.end, 1) << " s";
    }
    std::cout << "; microseconds in "
              << (queries_of_stepped_scene(span.scene) == 0 ? "dSpaceCollide()" : "20 dSpaceCollide2()")
              << " per tick\n\n";
    Table table({"space", "mean", "median", "p99", "p99.9", "max", "best ODE / this", "whole tick", "best whole / this",
                 "ticks", "pairs", "pair hash"});
    for (const Result &result : comparison.results)
    {
        const Statistics times = summarise(result.times);
        table.add({result.name, fixed(times.mean, 2), fixed(times.median, 2), fixed(times.p99, 2), fixed(times.p999, 2),
                   fixed(times.max, 2), ratio_text(collide_ratio(comparison, result)), fixed(result.mean_tick(), 2),
                   ratio_text(tick_ratio(comparison, result)), grouped(result.times.size()), grouped(result.pairs),
                   hexadecimal(result.pair_hash)});
    }
    table.print(std::cout);
    std::cout << '\n' << std::flush;
}

void record(const Span &span, const Comparison &comparison, Findings &findings)
{
    for (const Result &result : comparison.results)
    {
        const Statistics times = summarise(result.times);
        findings.record({{"table", "stepped"},
                         {"scene", span.scene},
                         {"n", comparison.spec.objects},
                         {"seed", comparison.spec.seed},
                         {"begin_s", value_if(span.is_window(), span.begin)},
                         {"end_s", value_if(span.is_window(), span.end)},
                         {"space", result.name},
                         {"ticks", result.ticks},
                         {"measured_ticks", result.times.size()},
                         {"mean_us", times.mean},
                         {"median_us", times.median},
                         {"p99_us", times.p99},
                         {"p999_us", times.p999},
                         {"max_us", times.max},
                         {"whole_us", result.mean_tick()},
                         {"pairs", result.pairs},
                         {"pair_hash", hexadecimal(result.pair_hash)},
                         {"false_pairs", result.false_pairs},
                         {"contacts", result.contacts},
                         {"best_ode_ratio", ratio_record(collide_ratio(comparison, result))},
                         {"best_ode_ratio_of_wholes", ratio_record(tick_ratio(comparison, result))}});
    }
}

void show(const Span &span, const Comparison &comparison, Findings &findings)
{
    print(span, comparison);
    record(span, comparison, findings);
}

void measure_case(const Case &one, const Options &options, Findings &findings)
{
    const Plan plan = plan_of(one, options, findings);
    const Comparison comparison = compare_single_ticks(plan, findings);
    if (one.scene != "settling")
    {
        show({one.scene}, comparison, findings);
        return;
    }
    const auto per_window = static_cast<std::size_t>(std::lround(seconds_per_window / PileScene::step_seconds));
    double begin = 0;
    for (const Comparison &window : windows_of(comparison, per_window))
    {
        show({one.scene, begin, begin + seconds_per_window}, window, findings);
        begin += seconds_per_window;
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
        command.footer(describe_all());
        command.add_option("--scenes", scenes_, "Scenes, or scenes and sizes, separated by commas: stack,gas:1000")
            ->delimiter(',');
    }

    void measure(const Options &options, Findings &findings) override
    {
        for (const Case &one : chosen(cases(), scenes_))
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
