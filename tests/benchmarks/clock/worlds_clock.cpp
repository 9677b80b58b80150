#include "tests/benchmarks/clock/agreement.h"
#include "tests/benchmarks/clock/clocks.h"
#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/contenders/pair_hash.h"
#include "tests/benchmarks/contenders/statistics.h"
#include "tests/benchmarks/contenders/world_run.h"

#include <algorithm>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

constexpr int ticks_per_turn = 100;

/// The spaces share one factory per world, so that a pile settles only once.
const WorldFactory &factory_of(const WorldSpec &spec)
{
    static std::map<std::pair<std::string, int>, std::unique_ptr<WorldFactory>> all;
    auto &factory = all[{spec.name, spec.objects}];
    if (factory == nullptr)
        factory = std::make_unique<WorldFactory>(spec);
    return *factory;
}

enum class Part
{
    collide,
    tick,
    contact
};

constexpr const char *name_of(Part part)
{
    return part == Part::collide ? "collide" : part == Part::tick ? "tick" : "contact";
}

double time_of(const WorldRun &run, Part part, std::size_t tick)
{
    switch (part)
    {
    case Part::tick:
        return run.measured().tick_times[tick];
    case Part::contact:
        return run.measured().collide_times[tick] + run.measured().contact_times[tick];
    case Part::collide:
        break;
    }
    return run.measured().collide_times[tick];
}

void check_pairs(benchmark::State &state, const WorldRun &run, const Row &row, Part part)
{
    const std::string what = row.name() + "/" + std::to_string(row.objects);
    if (part == Part::contact)
        Agreement::all().check(state, "contacts of " + what, hash_ticks(run.reported().touching_hashes));
    else if (run.contender().exact())
        Agreement::all().check(state, what, hash_ticks(run.reported().tick_hashes));
}

void count_calls(benchmark::State &state, const WorldRun &run)
{
    const auto per_tick = [&](std::uint64_t sum) {
        return static_cast<double>(sum) / static_cast<double>(run.measured().collide_times.size());
    };
    state.counters["calls"] = per_tick(run.measured().calls);
    state.counters["touching"] = per_tick(run.measured().touching);
    state.counters["collide_us"] = mean(run.measured().collide_times);
}

void clock_world(benchmark::State &state, const Row &row, const std::string &space, Part part)
{
    const WorldFactory &factory = factory_of(row.spec());
    WorldRun run(make_contender(space, factory), factory);
    if (part == Part::contact)
        run.measure_contacts();
    run.turn(row.clocked.first);
    run.start_measuring();
    std::vector<double> times;
    for (auto _ : state)
    {
        if (times.size() == run.measured().collide_times.size())
            run.turn(std::min(ticks_per_turn, row.clocked.count - static_cast<int>(times.size())));
        times.push_back(time_of(run, part, times.size()));
        state.SetIterationTime(1e-6 * times.back());
    }
    count_percentiles(state, times);
    state.counters["pairs"] =
        static_cast<double>(run.reported().pairs) / static_cast<double>(run.reported().tick_hashes.size());
    if (part == Part::contact)
        count_calls(state, run);
    check_pairs(state, run, row, part);
}

/// Contenders that are not ODE spaces take part only in the collide rows of scenes, without contacts.
bool takes_part(const std::string &space, const Row &row, Part part)
{
    if (row.objects > most_objects(space))
        return false;
    if (is_space(space))
        return true;
    return part == Part::collide && world_named(row.world).group == Group::scene && row.world != "churn" &&
           row.part.empty();
}

/// The simple space comes first, as the reference for the others.
std::vector<std::string> spaces_in_order()
{
    std::vector<std::string> names = contender_names();
    std::stable_partition(names.begin(), names.end(), [](const std::string &name) { return name == "simple"; });
    return names;
}

Row brief(Row row)
{
    row.objects = std::min(row.objects, brief_objects);
    row.clocked = {std::min(row.clocked.first, brief_ticks), std::min(row.clocked.count, brief_ticks)};
    return row;
}

void register_row(const Row &row)
{
    for (const Part part : {Part::collide, Part::tick, Part::contact})
    {
        for (const std::string &space : spaces_in_order())
        {
            if (!takes_part(space, row, part))
                continue;
            const std::string name = benchmark_name(name_of(part), row.name(), row.objects, space);
            const auto run = [row, space, part](benchmark::State &state) { clock_world(state, row, space, part); };
            benchmark::RegisterBenchmark(name.c_str(), run)
                ->Iterations(row.clocked.count)
                ->UseManualTime()
                ->Unit(benchmark::kMicrosecond);
        }
    }
}
} // namespace

void register_worlds(Extent extent)
{
    std::set<std::string> known; // brief rows have some names twice
    for (const Row &full : rows())
    {
        const Row row = extent == Extent::brief ? brief(full) : full;
        if (row.clocked.count > 0 && known.insert(benchmark_name("", row.name(), row.objects, "")).second)
            register_row(row);
    }
}
} // namespace ode_predictive_space::benchmarks
