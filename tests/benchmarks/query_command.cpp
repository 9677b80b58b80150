// predictive_bench query: probes and rays against a space.

#include "demos/runs/progress.h"
#include "demos/runs/statistics.h"
#include "demos/runs/table.h"
#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/query_measurement.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace ode_predictive_space::worlds;

constexpr int quick_query_ticks = 200;

/// What is asked for with so many objects: how many times as fast as the other spaces. Their queries take time that grows with
/// the objects, the predictive space's hardly do.
struct QueryLimits
{
    int objects;
    double quadtree;
    double others;
};

constexpr QueryLimits query_limits[] = {{1000, 1, 5}, {10000, 5, 50}};

class QueryCommand : public Command
{
public:
    std::string name() const override { return "query"; }
    std::string description() const override
    {
        return "20 spheres and 20 rays per tick that ask what is near them, by dSpaceCollide2(); gas 10,000";
    }
    void add_options(CLI::App &command) override
    {
        command.add_flag(
            "--without-collide", without_collide_,
            "Call no dSpaceCollide() before the queries: the first one of a tick then pays for the motion");
        command.add_flag("--still", still_, "Nothing moves but what asks, as where paths are planned");
    }
    void measure(const Options &options, Findings &findings) override;

private:
    QuerySettings settings(const Options &options) const;

    bool without_collide_ = false;
    bool still_ = false;
};

QuerySettings QueryCommand::settings(const Options &options) const
{
    QuerySettings settings;
    settings.objects = options.objects.value_or(settings.objects);
    settings.ticks = options.ticks.value_or(options.quick ? quick_query_ticks : settings.ticks);
    settings.seed = options.seed;
    settings.collide_first = !without_collide_;
    settings.still = still_;
    settings.check = options.check;
    settings.spaces = all_spaces();
    if (!options.spaces.empty())
    {
        settings.spaces.clear();
        for (const std::string &name : options.spaces)
        {
            settings.spaces.push_back(space_named(name));
        }
    }
    return settings;
}

void print(const std::vector<QueryResult> &results, const std::string &what, QuerySeries QueryResult::*series)
{
    std::cout << "\n20 " << what << " per tick, microseconds for all of them\n\n";
    Table table({"space", "mean", "median", "p99", "p99.9", "max", "pairs", "pair hash", "this / predictive-box"});
    for (const QueryResult &result : results)
    {
        const QuerySeries &queries = result.*series;
        const Statistics times = summarise(queries.times);
        const double ratio = query_ratio(results, {result.space}, series);
        table.add({space_name(result.space), fixed(times.mean, 2), fixed(times.median, 2), fixed(times.p99, 2),
                   fixed(times.p999, 2), fixed(times.max, 2), grouped(queries.pairs), hexadecimal(queries.pair_hash),
                   ratio > 0 ? fixed(ratio, 2) : "-"});
    }
    table.print(std::cout);
}

void require(const std::vector<QueryResult> &results, const std::string &what, QuerySeries QueryResult::*series,
             const QueryLimits &least, Findings &findings)
{
    const double to_quadtree = query_ratio(results, {SpaceKind::quadtree}, series);
    if (to_quadtree > 0)
    {
        findings.require(
            {"P7", what + ", against the quadtree", to_quadtree, Requirement::at_least, least.quadtree, "x"});
    }
    const double to_others =
        query_ratio(results, {SpaceKind::simple, SpaceKind::hash, SpaceKind::sweep_and_prune}, series);
    if (to_others > 0)
    {
        findings.require(
            {"P7", what + ", against the best of the others", to_others, Requirement::at_least, least.others, "x"});
    }
}

void QueryCommand::measure(const Options &options, Findings &findings)
{
    const QuerySettings chosen = settings(options);
    std::vector<QueryResult> results;
    {
        Progress progress("query", chosen.ticks);
        results = measure_queries(chosen, [&](int done) { progress.show(done); });
    }
    std::cout << "query, n = " << grouped(static_cast<std::uint64_t>(chosen.objects)) << ", seed " << chosen.seed
              << ", " << grouped(static_cast<std::uint64_t>(chosen.ticks)) << " ticks, "
              << (chosen.still ? "nothing moves but what asks, " : "")
              << (chosen.collide_first ? "each after dSpaceCollide()" : "without dSpaceCollide()") << '\n';
    print(results, "spheres", &QueryResult::spheres);
    print(results, "rays", &QueryResult::rays);
    for (const nlohmann::json &record : query_records(results, chosen))
    {
        findings.record(record);
    }
    for (const QueryLimits &least : query_limits)
    {
        if (least.objects == chosen.objects)
        {
            require(results, "20 spheres", &QueryResult::spheres, least, findings);
            require(results, "20 rays", &QueryResult::rays, least, findings);
        }
    }
    if (!same_pairs(results))
    {
        std::cerr << "query: the spaces did not all report the same pairs.\n";
        findings.fail(exit_wrong_pairs);
    }
    if (!all_valid(results))
    {
        std::cerr << "query: a predictive space did not pass its check.\n";
        findings.fail(exit_wrong_pairs);
    }
}
} // namespace

std::unique_ptr<Command> make_query_command()
{
    return std::make_unique<QueryCommand>();
}
} // namespace ode_predictive_space::benchmarks
