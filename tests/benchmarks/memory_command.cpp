// predictive_bench memory: bytes per geom, and whether they stay the same while geoms come and go.

#include "demos/runs/progress.h"
#include "demos/runs/table.h"
#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/memory_measurement.h"

#include <algorithm>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace ode_predictive_space::worlds;

constexpr int gas_objects = 100000;
constexpr int gas_ticks = 200;
constexpr int quick_gas_ticks = 20;
constexpr int mix_objects = 1000;
constexpr int pile_objects = 500;
constexpr int churn_objects = 1000;
constexpr int churn_ticks = 1000000;
constexpr int quick_churn_ticks = 30000;
constexpr int churn_samples = 100;

/// What counts as flat: the near set breathes a little.
constexpr double most_growth_of_bytes = 1.05;

class MemoryCommand : public Command
{
public:
    explicit MemoryCommand(bool only_shapes) : only_shapes_(only_shapes) {}

    std::string name() const override { return "memory"; }
    std::string description() const override
    {
        return "Bytes per geom in gas (--n) and mix, and whether they grow in churn 1,000 (--ticks)";
    }
    void measure(const Options &options, Findings &findings) override;

private:
    bool only_shapes_;
};

std::string per_geom(std::int64_t bytes, const WorldSpec &spec)
{
    return fixed(static_cast<double>(bytes) / spec.objects, 0);
}

std::vector<MemoryResult> measure_gas(const Options &options, bool only_shapes, Findings &findings)
{
    std::vector<SpaceKind> kinds;
    if (only_shapes)
    {
        kinds = {SpaceKind::predictive, SpaceKind::predictive_by_shapes};
    }
    for (const std::string &name : options.spaces)
    {
        kinds.push_back(space_named(name));
    }
    if (kinds.empty())
    {
        // At this size the simple and the hash space take seconds per tick, the quadtree minutes for its first.
        kinds = {SpaceKind::predictive, SpaceKind::predictive_by_shapes, SpaceKind::sweep_and_prune};
        if (!options.quick)
        {
            kinds.push_back(SpaceKind::quadtree);
        }
        findings.note(options.quick ? "memory, gas: without simple, hash and quadtree, which are too slow with so many"
                                    : "memory, gas: without simple and hash, which are too slow with so many");
    }
    std::vector<MemoryResult> results;
    for (const SpaceKind kind : kinds)
    {
        std::cerr << "memory, gas: " << space_name(kind) << '\n';
        results.push_back(measure_memory(kind, {"gas", options.objects.value_or(gas_objects), options.seed},
                                         options.quick ? quick_gas_ticks : gas_ticks, 1));
    }
    return results;
}

MemoryResult measure_churn(const Options &options)
{
    const int ticks = std::max(churn_samples, options.ticks.value_or(options.quick ? quick_churn_ticks : churn_ticks));
    Progress progress("churn", ticks);
    return measure_memory(SpaceKind::predictive, {"churn", churn_objects, options.seed}, ticks, churn_samples,
                          [&](int done) { progress.show(done); });
}

void print_gas(const std::vector<MemoryResult> &results)
{
    const WorldSpec &spec = results.front().spec;
    std::cout << "memory: gas, n = " << grouped(static_cast<std::uint64_t>(spec.objects)) << ", after "
              << results.front().samples.back().tick << " ticks; bytes per geom\n\n";
    Table table({"space", "counted by itself", "allocated", "allocated at work"});
    for (const MemoryResult &result : results)
    {
        const MemorySample &last = result.samples.back();
        table.add({space_name(result.space), last.counted > 0 ? per_geom(last.counted, spec) : "-",
                   per_geom(last.allocated, spec), per_geom(last.at_work, spec)});
    }
    table.print(std::cout);
}

void print_churn(const MemoryResult &result)
{
    std::cout << "\nchurn, n = " << grouped(static_cast<std::uint64_t>(result.spec.objects)) << ", "
              << space_name(result.space) << "; bytes per geom\n\n";
    Table table({"tick", "counted by itself", "allocated"});
    const std::size_t count = result.samples.size();
    for (const std::size_t i : {std::size_t{0}, count / 10, count / 4, count / 2, 3 * count / 4, count - 1})
    {
        const MemorySample &sample = result.samples[i];
        table.add({grouped(static_cast<std::uint64_t>(sample.tick)), per_geom(sample.counted, result.spec),
                   per_geom(sample.allocated, result.spec)});
    }
    table.print(std::cout);
}

void require_size(const MemoryResult &result, Findings &findings)
{
    if (result.space != SpaceKind::predictive && result.space != SpaceKind::predictive_by_shapes)
    {
        return;
    }
    const bool by_shapes = result.space == SpaceKind::predictive_by_shapes;
    const std::string where = result.spec.name + " " + grouped(static_cast<std::uint64_t>(result.spec.objects));
    const MemorySample &last = result.samples.back();
    for (const auto &[bytes, how] : {std::pair(last.counted, "counted"), std::pair(last.allocated, "allocated")})
    {
        findings.require({by_shapes ? "P21" : "P12", where + (by_shapes ? ", by shape, bytes " : ", bytes ") + how,
                          static_cast<double>(bytes) / result.spec.objects, Requirement::at_most, 400,
                          "bytes per geom"});
    }
}

void require_flatness(const MemoryResult &result, Findings &findings)
{
    const std::string where = "churn, second half of " +
                              grouped(static_cast<std::uint64_t>(result.samples.back().tick)) +
                              " ticks against the first, bytes ";
    findings.require({"P12", where + "counted", memory_growth(result, &MemorySample::counted), Requirement::at_most,
                      most_growth_of_bytes, "x"});
    findings.require({"P12", where + "allocated", memory_growth(result, &MemorySample::allocated), Requirement::at_most,
                      most_growth_of_bytes, "x"});
}

ShapeMemory measure_shapes(const std::string &scene, int objects, const Options &options)
{
    const WorldSpec spec{scene, objects, options.seed};
    const int ticks = options.quick ? quick_gas_ticks : gas_ticks;
    return {measure_memory(SpaceKind::predictive, spec, ticks, 1),
            measure_memory(SpaceKind::predictive_by_shapes, spec, ticks, 1)};
}

void report_shapes(const Options &options, Findings &findings)
{
    const ShapeMemory mix = measure_shapes("mix", mix_objects, options);
    const ShapeMemory gas = measure_shapes("gas", pile_objects, options);
    const ShapeMemory pile = measure_shapes("pile", pile_objects, options);
    std::cout << "\nThe measures of boxes and of shapes; bytes per geom. What is allocated is with the contact joints "
                 "of mix and pile.\n\n";
    Table table({"scene", "space", "counted by itself", "allocated", "near pairs", "postponed"});
    for (const ShapeMemory *scene : {&mix, &gas, &pile})
    {
        for (const MemoryResult *result : {&scene->by_boxes, &scene->by_shapes})
        {
            const MemorySample &last = result->samples.back();
            table.add({result->spec.name + " " + grouped(static_cast<std::uint64_t>(result->spec.objects)),
                       space_name(result->space), per_geom(last.counted, result->spec),
                       per_geom(last.allocated, result->spec), grouped(static_cast<std::uint64_t>(last.near)),
                       grouped(static_cast<std::uint64_t>(last.postponed))});
            findings.record(memory_record(*result));
        }
    }
    table.print(std::cout);
    require_size(mix.by_shapes, findings);
    const double per_pair = bytes_per_near_pair(gas, pile);
    findings.record({{"table", "memory of shapes"}, {"n", pile_objects}, {"bytes_per_near_pair", per_pair}});
    findings.require(
        {"P21", "pile 500, by shape, more than by box", per_pair, Requirement::at_most, 64, "bytes per near pair"});
}

void MemoryCommand::measure(const Options &options, Findings &findings)
{
    const std::vector<MemoryResult> gas = measure_gas(options, only_shapes_, findings);
    print_gas(gas);
    for (const MemoryResult &result : gas)
    {
        findings.record(memory_record(result));
        require_size(result, findings);
    }
    if (options.spaces.empty())
    {
        report_shapes(options, findings);
    }
    if (only_shapes_)
    {
        return;
    }
    const MemoryResult churn = measure_churn(options);
    print_churn(churn);
    findings.record(memory_record(churn));
    require_flatness(churn, findings);
}
} // namespace

std::unique_ptr<Command> make_memory_command(bool only_shapes)
{
    return std::make_unique<MemoryCommand>(only_shapes);
}
} // namespace ode_predictive_space::benchmarks
