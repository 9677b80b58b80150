// predictive_bench limits: what happens far outside of what programs usually have.

#include "demos/runs/table.h"
#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/limit_costs.h"
#include "tests/benchmarks/scene_choice.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <set>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

const std::vector<Limit> &limits()
{
    static const std::vector<Limit> all = {
        {"many", 1000, 200, 5},         {"many", 10000, 100, 5},        {"many", 100000, 20, 3},
        {"many", 1000000, 10, 1},       {"spot", 500, 20, 5},           {"spot", 2000, 20, 5},
        {"planes", 1000, 100, 5},       {"planes", 10000, 20, 5},       {"planes-all", 1000, 20, 5},
        {"planes-apart", 1000, 100, 5}, {"planes-apart", 10000, 20, 5}, {"planes-all", 10000, 2, 1},
        {"nested", 10, 100, 5},         {"nested", 100, 100, 5},        {"beside", 10, 100, 5},
        {"beside", 100, 100, 5},        {"huge", 1000, 200, 5},         {"huge", 10000, 100, 5},
        {"close", 1000, 200, 5},        {"away", 1000, 200, 5},         {"far", 1000, 50, 5},
        {"close", 4000, 100, 5},        {"away", 4000, 100, 5},         {"far", 4000, 20, 3},
        {"forwards", 10000, 10, 5},     {"backwards", 10000, 10, 5},    {"shuffled", 10000, 10, 5},
        {"forwards", 100000, 10, 3},    {"backwards", 100000, 10, 3},   {"shuffled", 100000, 10, 3},
    };
    return all;
}

struct MeasuredSpace
{
    SpaceKind kind;
    LimitCosts costs;
    double bytes_per_object = 0; ///< that the space holds, without the geoms
};

std::vector<SpaceKind> kinds_of(const Options &options)
{
    std::vector<SpaceKind> kinds;
    for (const std::string &name : options.spaces)
    {
        kinds.push_back(space_named(name));
    }
    return kinds.empty() ? std::vector<SpaceKind>{SpaceKind::predictive, SpaceKind::sweep_and_prune} : kinds;
}

std::vector<MeasuredSpace> measure_limit(const Limit &limit, const std::vector<SpaceKind> &kinds)
{
    // A simple space that is never collided keeps the geoms in ODE's list and nothing else.
    const LimitCosts bare = measure_once(limit, SpaceKind::simple, false);
    const std::vector<LimitCosts> costs = measure_by_turns(limit, kinds);
    std::vector<MeasuredSpace> result;
    for (std::size_t i = 0; i < kinds.size(); ++i)
    {
        result.push_back(
            {kinds[i], costs[i], static_cast<double>(costs[i].heap - bare.heap) / static_cast<double>(limit.objects)});
    }
    return result;
}

/// Sweep-and-prune over this space; not a number when that was not measured.
double ratio(const std::vector<MeasuredSpace> &spaces, const MeasuredSpace &space, double LimitCosts::*time)
{
    for (const MeasuredSpace &other : spaces)
    {
        if (other.kind == SpaceKind::sweep_and_prune && space.costs.*time > 0)
        {
            return other.costs.*time / (space.costs.*time);
        }
    }
    return std::nan("");
}

std::string text_of(double number)
{
    return std::isfinite(number) ? fixed(number, 2) : "-";
}

void print(const Limit &limit, const std::vector<MeasuredSpace> &spaces)
{
    std::cout << limit.scene << ", n = " << grouped(static_cast<std::uint64_t>(limit.objects)) << ": "
              << limit_world(limit.scene).text << "; milliseconds of the processor, and bytes per object\n\n";
    Table table({"space", "fill", "first collide", "motion", "collide", "empty", "bytes", "pairs", "sap / this: first",
                 "collide", "empty"});
    for (const MeasuredSpace &space : spaces)
    {
        const LimitCosts &costs = space.costs;
        table.add({space_name(space.kind), fixed(costs.fill, 2), fixed(costs.first, 2), fixed(costs.move, 3),
                   fixed(costs.collide, 3), fixed(costs.empty, 2), fixed(space.bytes_per_object, 0),
                   grouped(costs.pairs), text_of(ratio(spaces, space, &LimitCosts::first)),
                   text_of(ratio(spaces, space, &LimitCosts::collide)),
                   text_of(ratio(spaces, space, &LimitCosts::empty))});
    }
    table.print(std::cout);
    std::cout << '\n' << std::flush;
}

nlohmann::json value_of(double number)
{
    return std::isfinite(number) ? nlohmann::json(number) : nlohmann::json(nullptr);
}

void record(const Limit &limit, const std::vector<MeasuredSpace> &spaces, Findings &findings)
{
    for (const MeasuredSpace &space : spaces)
    {
        const LimitCosts &costs = space.costs;
        findings.record({{"table", "limits"},
                         {"scene", limit.scene},
                         {"n", limit.objects},
                         {"space", space_name(space.kind)},
                         {"ticks", limit.ticks},
                         {"rounds", limit.rounds},
                         {"fill_ms", costs.fill},
                         {"first_ms", costs.first},
                         {"move_ms", costs.move},
                         {"collide_ms", costs.collide},
                         {"empty_ms", costs.empty},
                         {"bytes_per_object", space.bytes_per_object},
                         {"pairs", costs.pairs},
                         {"pair_hash", hexadecimal(costs.pair_hash)},
                         {"sap_ratio_first", value_of(ratio(spaces, space, &LimitCosts::first))},
                         {"sap_ratio_collide", value_of(ratio(spaces, space, &LimitCosts::collide))},
                         {"sap_ratio_empty", value_of(ratio(spaces, space, &LimitCosts::empty))}});
    }
}

class LimitsCommand : public Command
{
public:
    std::string name() const override { return "limits"; }
    std::string description() const override
    {
        return "Very many, very large, very near, very far: a million geoms, 10,000 planes, coordinates of 1e12";
    }

    void add_options(CLI::App &command) override
    {
        std::string text = "Times are of the processor, the spaces in turn. Scenes:\n";
        std::set<std::string> told;
        for (const Limit &limit : limits())
        {
            if (told.insert(limit.scene).second)
            {
                text.append("  ").append(limit.scene).append(": ").append(limit_world(limit.scene).text).append("\n");
            }
        }
        command.footer(text);
        command.add_option("--scenes", scenes_, "Scenes, or scenes and sizes, separated by commas: spot,many:1000")
            ->delimiter(',');
    }

    void measure(const Options &options, Findings &findings) override
    {
        const std::vector<SpaceKind> kinds = kinds_of(options);
        for (Limit limit : chosen(limits(), scenes_))
        {
            if (options.objects.value_or(limit.objects) != limit.objects)
            {
                continue;
            }
            limit.ticks = options.ticks.value_or(limit.ticks);
            limit.rounds = options.quick ? 1 : limit.rounds;
            const std::vector<MeasuredSpace> spaces = measure_limit(limit, kinds);
            print(limit, spaces);
            record(limit, spaces, findings);
        }
    }

private:
    std::vector<std::string> scenes_;
};
} // namespace

std::unique_ptr<Command> make_limits_command()
{
    return std::make_unique<LimitsCommand>();
}
} // namespace ode_predictive_space::benchmarks
