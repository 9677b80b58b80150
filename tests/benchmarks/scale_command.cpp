// predictive_bench scale: how the costs grow with the number of objects.

#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"

#include "demos/runs/table.h"
#include "tests/benchmarks/contenders/contenders.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

constexpr double seconds_per_scale = 5;
constexpr double quick_seconds_per_scale = 0.3;
constexpr double most_growth_of_time = 2; ///< of the time per moved geom from 10,000 to 100,000 objects

/// A scene of one size.
struct Step
{
    const char *scene;
    int objects;
    double moving; ///< share of the objects; < 0: the scene's own
    int ticks;
};

/// In gas the step to 100,000 objects is made with 10 % of them moving, from 10,000 of which 10 % move.
constexpr Step gas_steps[] = {{"gas", 10, -1, 50000},   {"gas", 100, -1, 20000},   {"gas", 1000, -1, 3000},
                              {"gas", 10000, -1, 1000}, {"gas", 10000, 0.1, 1000}, {"gas", 100000, 0.1, 100}};
constexpr Step game_steps[] = {{"game", 10, -1, 50000},
                               {"game", 100, -1, 20000},
                               {"game", 1000, -1, 2000},
                               {"game", 10000, -1, 300},
                               {"game", 100000, -1, 50}};

double share_moving(const Step &step)
{
    return step.moving >= 0 ? step.moving : (std::string(step.scene) == "gas" ? 0.5 : 1);
}

std::string title(const Step &step)
{
    return grouped(static_cast<std::uint64_t>(step.objects)) + " (" + fixed(100 * share_moving(step), 0) + " % moving)";
}

struct Measured
{
    Step step;
    std::shared_ptr<const Comparison> comparison;

    /// Mean time per moved geom, in nanoseconds; not a number when the contender did not take part.
    double per_moved(const std::string &contender) const
    {
        const Result *result = comparison->find(contender);
        return result == nullptr ? std::nan("") : 1000 * result->mean() / (step.objects * share_moving(step));
    }
};

std::vector<std::string> scale_contenders()
{
    std::vector<std::string> names = contender_names();
    names.erase(std::remove(names.begin(), names.end(), "brute"), names.end());
    return names;
}

Measured measure_step(const Step &step, const Options &options, Findings &findings)
{
    const WorldSpec spec{step.scene, step.objects, options.seed, step.moving};
    Plan plan = plan_for(spec, fast_enough(scale_contenders(), spec, findings), step.ticks, options);
    plan.seconds_each = options.quick ? quick_seconds_per_scale : seconds_per_scale;
    return {step, compare_once(plan, findings)};
}

std::string cell(double number, int decimals)
{
    return std::isfinite(number) ? fixed(number, decimals) : "-";
}

/// The exponent p of time ~ n^p per moved geom: 0 when a geom costs the same however many there are.
double growth_exponent(const Measured &smaller, const Measured &larger, const std::string &contender)
{
    const double growth = larger.per_moved(contender) / smaller.per_moved(contender);
    return std::log10(growth) / std::log10(static_cast<double>(larger.step.objects) / smaller.step.objects);
}

/// The step before this one that moves the same share of its objects; null when there is none.
const Measured *comparable(const std::vector<Measured> &all, const Measured &one)
{
    const auto found = std::find_if(all.rbegin(), all.rend(), [&](const Measured &other) {
        return other.step.objects < one.step.objects && share_moving(other.step) == share_moving(one.step);
    });
    return found == all.rend() ? nullptr : &*found;
}

void print_growth(const std::vector<Measured> &all, const std::vector<std::string> &names)
{
    std::cout << all.front().step.scene << ": nanoseconds per moved geom, and the exponent of their growth\n\n";
    Table::Row head = {"objects"};
    head.insert(head.end(), names.begin(), names.end());
    Table table(head);
    for (const Measured &one : all)
    {
        Table::Row row = {title(one.step)};
        for (const std::string &name : names)
        {
            const Measured *before = comparable(all, one);
            const double exponent = before == nullptr ? std::nan("") : growth_exponent(*before, one, name);
            row.push_back(cell(one.per_moved(name), 1) +
                          (std::isfinite(exponent) ? " (" + cell(exponent, 2) + ")" : ""));
        }
        table.add(row);
    }
    table.print(std::cout);
    std::cout << '\n';
}

void require_growth(const std::vector<Measured> &all, Findings &findings)
{
    const Measured &large = all.back();
    const Measured *small = comparable(all, large);
    if (small == nullptr)
    {
        return;
    }
    const double ours = large.per_moved("predictive-box") / small->per_moved("predictive-box");
    const double floor = large.per_moved("floor") / small->per_moved("floor");
    if (std::isfinite(ours) && std::isfinite(floor))
    {
        findings.require({"P13",
                          "gas, 10 % moving, time per moved geom from 10,000 to 100,000, over the floor's (" +
                              fixed(ours, 2) + " / " + fixed(floor, 2) + ")",
                          ours / std::max(1.0, floor), Requirement::at_most, most_growth_of_time, "x"});
    }
}

class ScaleCommand : public Command
{
public:
    std::string name() const override { return "scale"; }
    std::string description() const override { return "From 10 to 100,000 objects, in gas and game"; }

    void measure(const Options &options, Findings &findings) override
    {
        require_growth(measure_scene(gas_steps, std::size(gas_steps), options, findings), findings);
        measure_scene(game_steps, std::size(game_steps) - (options.quick ? 1 : 0), options, findings);
        if (options.quick)
        {
            findings.note("game with 100,000 objects was left out of the quick run");
        }
    }

private:
    static std::vector<Measured> measure_scene(const Step *steps, std::size_t count, const Options &options,
                                               Findings &findings)
    {
        std::vector<Measured> all;
        for (const Step *step = steps; step != steps + count; ++step)
        {
            if (step->objects <= options.objects.value_or(step->objects))
            {
                all.push_back(measure_step(*step, options, findings));
            }
        }
        if (!all.empty())
        {
            print_growth(all, options.spaces.empty() ? scale_contenders() : options.spaces);
        }
        return all;
    }
};
} // namespace

std::unique_ptr<Command> make_scale_command()
{
    return std::make_unique<ScaleCommand>();
}
} // namespace ode_predictive_space::benchmarks
