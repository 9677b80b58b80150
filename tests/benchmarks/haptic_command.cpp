// predictive_bench haptic: how many objects a loop at 1 kHz can have.

#include "demos/runs/table.h"
#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/haptic_measurement.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace ode_predictive_space::worlds;

constexpr int quick_haptic_ticks = 1000;
constexpr int quick_first = 2000;
constexpr double quick_precision = 1.2;

const char *explain(HapticTick tick)
{
    switch (tick)
    {
    case HapticTick::kinematic:
        return "device, motion of the objects along given paths, collision detection, force";
    case HapticTick::stepped:
        return "device, dWorldQuickStep(), collision detection, force on the probe and on what it touches";
    case HapticTick::collide:
        break;
    }
    return "device, collision detection, force; the objects are moved between the ticks";
}

class HapticCommand : public Command
{
public:
    std::string name() const override { return "haptic"; }
    std::string description() const override
    {
        return "The most objects (--n: to try at most) with which a haptic loop keeps 99.9 % of its 1 ms ticks";
    }
    void add_options(CLI::App &command) override
    {
        command.add_option("--tick", contents_, "What a tick contains, separated by commas; all by default")
            ->delimiter(',')
            ->check(CLI::IsMember(all_contents()));
    }
    void measure(const Options &options, Findings &findings) override;

private:
    bool is_wanted(HapticTick tick) const
    {
        return std::find(contents_.begin(), contents_.end(), haptic_tick_name(tick)) != contents_.end();
    }

    static std::vector<std::string> all_contents()
    {
        std::vector<std::string> names;
        for (const HapticTick tick : all_haptic_ticks)
        {
            names.push_back(haptic_tick_name(tick));
        }
        return names;
    }

    std::vector<std::string> contents_ = all_contents(); ///< also when `all` runs this, which adds no options
};

HapticSettings settings(const Options &options)
{
    HapticSettings settings;
    if (options.quick)
    {
        settings.ticks = quick_haptic_ticks;
        settings.first = quick_first;
        settings.precision = quick_precision;
    }
    settings.ticks = options.ticks.value_or(settings.ticks);
    settings.most = options.objects.value_or(settings.most);
    settings.first = std::min(settings.first, settings.most);
    settings.seed = options.seed;
    return settings;
}

std::vector<SpaceKind> spaces(const Options &options, Findings &findings)
{
    std::vector<SpaceKind> kinds;
    for (const std::string &name : options.spaces)
    {
        kinds.push_back(space_named(name));
    }
    if (kinds.empty() && options.quick)
    {
        findings.note("haptic: without simple and hash, which keep up with fewer objects than quadtree and sap");
        return {SpaceKind::predictive, SpaceKind::quadtree, SpaceKind::sweep_and_prune};
    }
    return kinds.empty() ? all_spaces() : kinds;
}

std::vector<HapticResult> search(const std::vector<SpaceKind> &kinds, const HapticSettings &settings)
{
    std::vector<HapticResult> results;
    results.reserve(kinds.size());
    for (const SpaceKind kind : kinds)
    {
        results.push_back(most_objects(kind, settings, [&](int objects) {
            std::cerr << "haptic, " << haptic_tick_name(settings.tick) << ", " << space_name(kind) << ": trying "
                      << grouped(static_cast<std::uint64_t>(objects)) << " objects\n";
        }));
    }
    return results;
}

void print(const std::vector<HapticResult> &results, HapticTick tick)
{
    std::cout << '\n' << haptic_tick_name(tick) << ": " << explain(tick) << "\n\n";
    Table table({"space", "objects", "mean", "median", "p99.9", "max", "objects / best ODE's"});
    for (const HapticResult &result : results)
    {
        const Statistics &times = result.at_most.times;
        const double ratio = haptic_ratio(results, result);
        table.add({space_name(result.space), grouped(static_cast<std::uint64_t>(result.objects)), fixed(times.mean, 1),
                   fixed(times.median, 1), fixed(times.p999, 1), fixed(times.max, 1),
                   ratio > 0 ? fixed(ratio, 2) : "-"});
    }
    table.print(std::cout);
}

void require(const std::vector<HapticResult> &results, HapticTick tick, Findings &findings)
{
    for (const HapticResult &result : results)
    {
        const double ratio = haptic_ratio(results, result);
        if (result.space == SpaceKind::predictive && ratio > 0)
        {
            findings.require({"P14", "objects in a haptic loop, tick: " + haptic_tick_name(tick), ratio,
                              Requirement::at_least, 5, "x"});
        }
    }
}

void HapticCommand::measure(const Options &options, Findings &findings)
{
    HapticSettings chosen = settings(options);
    const std::vector<SpaceKind> kinds = spaces(options, findings);
    std::cout << "haptic, seed " << chosen.seed << ": the most objects with which 99.9 % of "
              << grouped(static_cast<std::uint64_t>(chosen.ticks))
              << " ticks compute for 1 ms at most; microseconds per tick with so many\n";
    for (const HapticTick tick : all_haptic_ticks)
    {
        if (!is_wanted(tick))
        {
            continue;
        }
        chosen.tick = tick;
        const std::vector<HapticResult> results = search(kinds, chosen);
        print(results, tick);
        require(results, tick, findings);
        for (const nlohmann::json &record : haptic_records(results, chosen))
        {
            findings.record(record);
        }
        if (!same_forces(results))
        {
            std::cerr << "haptic: the probe did not feel the same in all spaces.\n";
            findings.fail(exit_wrong_pairs);
        }
    }
}
} // namespace

std::unique_ptr<Command> make_haptic_command()
{
    return std::make_unique<HapticCommand>();
}
} // namespace ode_predictive_space::benchmarks
