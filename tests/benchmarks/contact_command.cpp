// predictive_bench contact: broad and narrow phase together, dSpaceCollide() and the dCollide() calls for what it reports.

#include "demos/worlds/world.h"
#include "tests/benchmarks/batches.h"
#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/scene_choice.h"
#include "tests/benchmarks/table1.h"

#include "demos/runs/table.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

const std::string by_boxes = "predictive-box";
const std::string by_shapes = "predictive-shape";

/// The limits for one scene. They are limits for predictive-shape, unless noted otherwise; 0 means no limit.
struct ContactLimits
{
    double best_ode = 0;  ///< at least so many times as fast as the best ODE space
    double boxes = 0;     ///< at least so many times as fast as predictive-box
    double calls = 0;     ///< at most so many dCollide() calls per pair with contacts
    double all_calls = 0; ///< at most so many dCollide() calls per tick
    const char *line_of_boxes = "P18";
    double collide =
        0; ///< of predictive-box: at least so many times as fast as the best ODE space, dSpaceCollide() alone
};

struct ContactCase
{
    std::string scene;
    int objects;
    int warm_up_ticks;
    int ticks;
    ContactLimits limits{};
};

const std::vector<ContactCase> &contact_cases()
{
    static const std::vector<ContactCase> all = {
        {"mix", 100, 200, 16000, {4}},
        {"mix", 1000, 100, 3000, {8, 0, 3}},
        {"mix", 10000, 100, 500, {20}},
        {"classes", 1000, 100, 1000, {0, 1.3}},
        {"game", 1000, 100, 1000},
        {"pile", 500, 100, 1000, {0, 0.97, 0, 0, "P19"}},
        {"pile", 2000, 100, 400, {0, 0.97, 0, 0, "P19"}},
        {"stack", 1000, 100, 1200, {0, 0.97, 0, 0, "P19"}}, // the ball is thrown every 400 ticks
        {"terrain", 1000, 100, 1000},
        {"gas", 1000, 100, 3000},
        {"gas", 10000, 100, 500},
        {"dart", 1000, 100, 3000, {0, 0, 0, 0, "", 10}},
        {"dart", 3000, 100, 1000, {0, 0, 0, 0, "", 20}},
        {"room", 1000, 300, 1000, {3, 0, 0, 30}},
        {"hills", 1000, 300, 1000, {0, 0, 0, 6}},
        {"drones", 300, 50, 1000},
    };
    return all;
}

/// Nothing is asked in a size that the command does not have by itself.
ContactLimits limits_of(const ContactCase &measured)
{
    for (const ContactCase &one : contact_cases())
    {
        if (one.scene == measured.scene && one.objects == measured.objects)
        {
            return one.limits;
        }
    }
    return {};
}

std::string title(const ContactCase &one)
{
    return one.scene + " " + grouped(static_cast<std::uint64_t>(one.objects));
}

std::vector<std::string> contact_contenders()
{
    std::vector<std::string> names = {by_boxes, "predictive-sphere", by_shapes};
    names.insert(names.end(), ode_spaces().begin(), ode_spaces().end());
    return names;
}

/// Some cannot take part: their pairs come too late for a near callback.
std::vector<std::string> without_late_ones(std::vector<std::string> names, Findings &findings)
{
    const auto late = [](const std::string &name) { return name == "brute" || is_floor(name); };
    const auto end = std::remove_if(names.begin(), names.end(), late);
    if (end != names.end())
    {
        findings.note("contact: without brute and floors, which call no near callback for what they find");
        names.erase(end, names.end());
    }
    return names;
}

Plan plan_of(const ContactCase &one, const Options &options, Findings &findings)
{
    const WorldSpec spec{one.scene, one.objects, options.seed};
    Plan plan = plan_for(spec, fast_enough(contact_contenders(), spec, findings), one.ticks, options);
    plan.contenders = without_late_ones(plan.contenders, findings);
    plan.warm_up_ticks = one.warm_up_ticks;
    plan.seconds_each = unlimited;
    plan.weigh = false;
    plan.contacts = true;
    plan.world = one.scene == "mix" ? "" : stepped_world(one.scene).name; // mix in batches
    return plan;
}

/// Not a number when there is nothing to compare with.
double ratio_of(double one, double other)
{
    return other > 0 ? one / other : std::nan("");
}

double ratio_to(const Result *other, double (Result::*mean)() const, const Result &result)
{
    return other != nullptr ? ratio_of((other->*mean)(), (result.*mean)()) : std::nan("");
}

/// What is shown and recorded of one contender.
struct Figures
{
    double collide, both, whole;               ///< microseconds per tick
    double best_ode_ratio, best_whole, to_box; ///< how many times as long the others take
    double calls_per_touching;

    Figures(const Comparison &comparison, const Result &result)
        : collide(result.mean()), both(result.mean_of_both()), whole(result.mean_tick()),
          best_ode_ratio(ratio_to(comparison.best_of_ode_with_contacts(), &Result::mean_of_both, result)),
          best_whole(ratio_to(comparison.best_of_ode_by_ticks(), &Result::mean_tick, result)),
          to_box(ratio_to(comparison.find(by_boxes), &Result::mean_of_both, result)),
          calls_per_touching(ratio_of(result.calls_per_tick, result.touching_per_tick))
    {}
};

std::string number_text(double number)
{
    return std::isfinite(number) ? fixed(number, 2) : "-";
}

nlohmann::json number_record(double number)
{
    return std::isfinite(number) ? nlohmann::json(number) : nlohmann::json(nullptr);
}

void print(const ContactCase &one, const Comparison &comparison)
{
    std::cout << title(one) << ", seed " << comparison.spec.seed
              << "; mean microseconds per tick in dSpaceCollide() and in dCollide() for the reported pairs"
              << (comparison.in_batches ? ", of batches of " + std::to_string(ticks_per_batch) + " ticks" : "")
              << "\n\n";
    Table table({"space", "collide", "dCollide", "sum", "best ODE / this", "box / this", "whole tick",
                 "best whole / this", "calls", "touching", "calls per touching", "hash of touching"});
    for (const Result &result : comparison.results)
    {
        const Figures figures(comparison, result);
        table.add({result.name, fixed(figures.collide, 2), fixed(figures.both - figures.collide, 2),
                   fixed(figures.both, 2), number_text(figures.best_ode_ratio), number_text(figures.to_box),
                   fixed(figures.whole, 2), number_text(figures.best_whole), fixed(result.calls_per_tick, 2),
                   fixed(result.touching_per_tick, 2), number_text(figures.calls_per_touching),
                   hexadecimal(result.touching_hash)});
    }
    table.print(std::cout);
    std::cout << '\n' << std::flush;
}

void record(const ContactCase &one, const Comparison &comparison, Findings &findings)
{
    for (const Result &result : comparison.results)
    {
        const Figures figures(comparison, result);
        findings.record({{"table", "contact"},
                         {"scene", one.scene},
                         {"n", comparison.spec.objects},
                         {"seed", comparison.spec.seed},
                         {"space", result.name},
                         {"ticks", result.ticks},
                         {"measured_ticks", result.clock_times.size()},
                         {"in_batches", comparison.in_batches},
                         {"collide_us", figures.collide},
                         {"dcollide_us", figures.both - figures.collide},
                         {"sum_us", figures.both},
                         {"whole_us", figures.whole},
                         {"calls_per_tick", result.calls_per_tick},
                         {"touching_per_tick", result.touching_per_tick},
                         {"calls_per_touching", number_record(figures.calls_per_touching)},
                         {"touching_hash", hexadecimal(result.touching_hash)},
                         {"best_ode_ratio", number_record(figures.best_ode_ratio)},
                         {"best_ode_ratio_of_wholes", number_record(figures.best_whole)},
                         {"box_ratio", number_record(figures.to_box)}});
    }
}

void require(const ContactCase &one, const Comparison &comparison, Findings &findings)
{
    const ContactLimits limits = limits_of(one);
    const Result *ours = comparison.find(by_shapes);
    const Result *boxes = comparison.find(by_boxes);
    const Result *best = comparison.best_of_ode_with_contacts();
    const Result *best_alone = comparison.best_of_ode();
    if (limits.collide > 0 && boxes != nullptr && best_alone != nullptr)
    {
        findings.require({"P22", title(one) + ", collide alone, best ODE (" + best_alone->name + ") / predictive-box",
                          ratio_of(best_alone->mean(), boxes->mean()), Requirement::at_least, limits.collide, "x"});
    }
    if (ours == nullptr)
    {
        return;
    }
    const Figures figures(comparison, *ours);
    const std::string where = title(one) + ", collide and dCollide, ";
    if (limits.best_ode > 0 && best != nullptr)
    {
        findings.require({"P18", where + "best ODE (" + best->name + ") / predictive-shape", figures.best_ode_ratio,
                          Requirement::at_least, limits.best_ode, "x"});
    }
    if (limits.boxes > 0 && boxes != nullptr)
    {
        findings.require({limits.line_of_boxes, where + "predictive-box / predictive-shape", figures.to_box,
                          Requirement::at_least, limits.boxes, "x"});
        findings.require({limits.line_of_boxes, title(one) + ", calls of dCollide in predictive-shape",
                          ours->calls_per_tick, Requirement::at_most, boxes->calls_per_tick, "per tick"});
    }
    if (limits.all_calls > 0)
    {
        findings.require({"P23", title(one) + ", calls of dCollide in predictive-shape", ours->calls_per_tick,
                          Requirement::at_most, limits.all_calls, "per tick"});
    }
    if (limits.calls > 0 && ours->touching_per_tick > 0)
    {
        findings.require({"P20", title(one) + ", calls of dCollide per pair with contacts", figures.calls_per_touching,
                          Requirement::at_most, limits.calls, "calls"});
    }
}

void measure_gains(const Options &options, Findings &findings)
{
    const Table1 table = measure_table1(by_shapes, options, findings);
    std::cout
        << "The paper's Table 1 with predictive-shape: mean times per tick in mix, and the gain (T_other - T_ours) / "
           "T_other in percent, here / in the paper\n\n";
    show(table, table.narrow, options.seed, findings);
    show(table, table.whole, options.seed, findings);
    findings.require({"P16", "mix 20 to 100, gains as in the paper, broad and narrow phase",
                      static_cast<double>(table.narrow.cells_reached()), Requirement::at_least, 17, "of 20 cells"});
    findings.require({"P16", "mix 20 to 100, gains as in the paper, whole tick",
                      static_cast<double>(table.whole.cells_reached()), Requirement::at_least, 8, "of 20 cells"});
}

/// In a simulated processor. Without valgrind the other figures are of use all the same.
void measure_instructions(const Options &options, Findings &findings)
{
    try
    {
        make_instructions_command(true)->measure(options, findings);
    }
    catch (const std::runtime_error &failure)
    {
        findings.note(std::string("contact: without instructions: ") + failure.what());
    }
}

class ContactCommand : public Command
{
public:
    std::string name() const override { return "contact"; }
    std::string description() const override
    {
        return "Broad and narrow phase together: dSpaceCollide() and dCollide() for the pairs that it reports";
    }

    void add_options(CLI::App &command) override
    {
        command.footer(
            "All contenders must come to the same pairs with contacts, tick by tick. The world is stepped "
            "between two ticks.\nmix with fewer than 300 objects is timed in batches. Without --scenes, --n and "
            "--spaces there follow\nthe paper's Table 1 with the narrow phase and with whole ticks, the memory of "
            "the measure of shapes,\nand the instructions of whole ticks.");
        command.add_option("--scenes", scenes_, "Scenes, or scenes and sizes, separated by commas: stack,mix:1000")
            ->delimiter(',');
        command.add_flag("--table1", only_table1_, "Measure only the paper's Table 1");
    }

    void measure(const Options &options, Findings &findings) override
    {
        for (const ContactCase &one : only_table1_ ? std::vector<ContactCase>() : chosen(contact_cases(), scenes_))
        {
            if (options.objects.value_or(one.objects) == one.objects)
            {
                const Plan plan = plan_of(one, options, findings);
                const Comparison comparison = compare(plan, findings);
                print(one, comparison);
                record(one, comparison, findings);
                require(one, comparison, findings);
            }
        }
        const bool all = !only_table1_ && scenes_.empty() && !options.objects && options.spaces.empty();
        if (all || only_table1_)
        {
            measure_gains(options, findings);
        }
        if (all)
        {
            make_memory_command(true)->measure(options, findings);
            measure_instructions(options, findings);
        }
    }

private:
    std::vector<std::string> scenes_;
    bool only_table1_ = false;
};
} // namespace

std::unique_ptr<Command> make_contact_command()
{
    return std::make_unique<ContactCommand>();
}
} // namespace ode_predictive_space::benchmarks
