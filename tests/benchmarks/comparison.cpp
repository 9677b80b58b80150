#include "tests/benchmarks/comparison.h"

#include "demos/runs/progress.h"
#include "demos/runs/table.h"
#include "tests/benchmarks/batches.h"
#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/weight.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <iterator>
#include <numeric>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

std::string title(const WorldSpec &spec)
{
    return spec.name + " " + grouped(static_cast<std::uint64_t>(spec.objects));
}

WorldRuns make_runs(const Plan &plan, const WorldFactory &factory, Findings &findings)
{
    WorldRuns runs;
    for (const std::string &name : plan.contenders)
    {
        const std::string reason = why_not(name, plan.spec);
        if (!reason.empty())
        {
            findings.note(title(plan.spec).append(", without ").append(name).append(": ").append(reason));
            continue;
        }
        auto contender = benchmarks::make_contender(name, factory);
        runs.push_back(std::make_unique<WorldRun>(std::move(contender), factory));
        runs.back()->ask_only(plan.queries);
        if (plan.contacts)
        {
            runs.back()->measure_contacts();
        }
        if (plan.check)
        {
            runs.back()->check_every_tick();
        }
    }
    return runs;
}

// However little time there is: a new predictive space scans for some ticks, and then predicts for some.
constexpr int least_warm_up = 16;

void make_ticks(const Plan &plan, const WorldRuns &runs)
{
    run_by_turns(runs, std::min(plan.warm_up_ticks, least_warm_up), {});
    run_by_turns(runs, plan.warm_up_ticks - least_warm_up, {}, plan.seconds_each / 2);
    for (const auto &run : runs)
    {
        run->start_measuring();
    }
    Progress progress(title(plan.spec), plan.ticks);
    run_by_turns(
        runs, plan.ticks, [&](int done) { progress.show(done); }, plan.seconds_each);
}

std::uint64_t hash_of(const std::vector<std::uint64_t> &tick_hashes)
{
    PairHash hash;
    for (const std::uint64_t tick_hash : tick_hashes)
    {
        hash.add_tick(tick_hash);
    }
    return hash.value();
}

void add_contacts(const WorldRun &run, Result &result)
{
    std::transform(run.collide_times().begin(), run.collide_times().end(), run.contact_times().begin(),
                   std::back_inserter(result.both_times), std::plus<>());
    const auto ticks = static_cast<double>(std::max<std::size_t>(1, run.measured_ticks()));
    result.calls_per_tick = static_cast<double>(run.calls()) / ticks;
    result.touching_per_tick = static_cast<double>(run.touching()) / ticks;
    result.touching_hash = hash_of(run.touching_hashes());
}

Result result_of(const WorldRun &run, bool with_contacts)
{
    Result result;
    result.name = run.name();
    result.family = run.contender().family();
    result.exact = run.contender().exact();
    result.times = run.collide_times();
    result.clock_times = run.collide_times();
    result.tick_times = run.tick_times();
    result.ticks = run.ticks();
    result.pairs = run.pairs();
    result.pair_hash = run.pair_hash();
    result.false_pairs = run.false_pairs();
    result.contacts = run.contacts();
    if (with_contacts)
    {
        add_contacts(run, result);
    }
    return result;
}

// A space that leaves out pairs without contacts must not leave out one with: the same contacts as the exact ones.
bool contacts_agree(const WorldRuns &runs)
{
    return std::all_of(runs.begin(), runs.end(), [&](const auto &run) {
        return run->ticks() != runs.front()->ticks() || run->contacts() == runs.front()->contacts();
    });
}

void judge(const Plan &plan, const WorldRuns &runs, Findings &findings)
{
    const std::string where = " (" + title(plan.spec) + ")\n";
    const int tick = first_difference(runs);
    if (tick >= 0)
    {
        std::cerr << "THE CONTENDERS DISAGREE: from tick " << tick << " on they did not all report the same pairs"
                  << where;
        findings.fail(exit_wrong_pairs);
    }
    else if (!contacts_agree(runs))
    {
        std::cerr << "THE CONTENDERS DISAGREE: they did not all come to the same contacts" << where;
        findings.fail(exit_wrong_pairs);
    }
    const int contact_tick = first_difference_of_contacts(runs);
    if (contact_tick >= 0)
    {
        std::cerr << "THE CONTENDERS DISAGREE: from tick " << contact_tick
                  << " on they did not all report the same pairs with contacts" << where;
        findings.fail(exit_wrong_pairs);
    }
    for (const auto &run : runs)
    {
        if (!run->invariant_held())
        {
            std::cerr << "The " << run->name() << " space did not pass its check" << where;
            findings.fail(exit_wrong_pairs);
        }
    }
}

WorldFactory factory_of(const Plan &plan)
{
    WorldSpec spec = plan.spec;
    spec.name = plan.world.empty() ? spec.name : plan.world;
    return WorldFactory(spec);
}

Comparison compare_with(const Plan &plan, const WorldFactory &factory, Findings &findings)
{
    Comparison comparison;
    comparison.spec = plan.spec;
    const WorldRuns runs = make_runs(plan, factory, findings);
    make_ticks(plan, runs);
    judge(plan, runs, findings);
    for (const auto &run : runs)
    {
        Result result = result_of(*run, plan.contacts);
        const dSpaceID space = run->contender().space();
        if (const auto bytes = told_bytes(space))
        {
            result.bytes_per_geom = static_cast<double>(*bytes) / dSpaceGetNumGeoms(space);
        }
        else if (plan.weigh)
        {
            result.bytes_per_geom = bytes_per_geom(run->name(), factory);
        }
        comparison.results.push_back(std::move(result));
    }
    return comparison;
}

void time_in_batches(Comparison &comparison, const Plan &plan, const WorldFactory &factory)
{
    std::vector<std::string> names;
    for (const Result &result : comparison.results)
    {
        names.push_back(result.name);
    }
    const auto times = measure_batches(factory, names, plan.ticks, NearCallback::collect);
    for (std::size_t i = 0; i < times.size(); ++i)
    {
        comparison.results[i].times = times[i];
    }
    if (plan.contacts)
    {
        const auto both = measure_batches(factory, names, plan.ticks, NearCallback::find_contacts);
        for (std::size_t i = 0; i < both.size(); ++i)
        {
            comparison.results[i].both_times = both[i];
        }
    }
    comparison.in_batches = true;
}

bool same(const WorldSpec &one, const WorldSpec &other)
{
    return one.name == other.name && one.objects == other.objects && one.seed == other.seed &&
           one.moving == other.moving;
}

bool covers(const Comparison &comparison, const Plan &plan)
{
    return same(comparison.spec, plan.spec) &&
           std::all_of(plan.contenders.begin(), plan.contenders.end(), [&](const std::string &name) {
               return comparison.find(name) != nullptr || !why_not(name, plan.spec).empty();
           });
}

/// Number of the first tick that was timed, of those that the contender made.
std::size_t first_measured(const Result &result)
{
    return result.ticks - result.clock_times.size();
}

double sum_of_ticks(const Result &result, std::size_t first, std::size_t end)
{
    const auto time_of = [&](std::size_t tick) {
        return result.clock_times.begin() + static_cast<std::ptrdiff_t>(tick - first_measured(result));
    };
    return std::accumulate(time_of(first), time_of(end), 0.0);
}

const Result *least_of_ode(const std::vector<Result> &results, double (Result::*mean)() const)
{
    const Result *best = nullptr;
    for (const Result &result : results)
    {
        if (result.family == Family::ode && (best == nullptr || (result.*mean)() < (best->*mean)()))
        {
            best = &result;
        }
    }
    return best;
}
} // namespace

const Result *Comparison::find(const std::string &name) const
{
    const auto found =
        std::find_if(results.begin(), results.end(), [&](const Result &result) { return result.name == name; });
    return found == results.end() ? nullptr : &*found;
}

const Result *Comparison::best_of_ode() const
{
    return least_of_ode(results, &Result::mean);
}

const Result *Comparison::best_of_ode_by_ticks() const
{
    return least_of_ode(results, &Result::mean_tick);
}

const Result *Comparison::best_of_ode_with_contacts() const
{
    return least_of_ode(results, &Result::mean_of_both);
}

// Fewer common ticks say less than the means of all: a turn begins with cold caches.
double Comparison::ratio(const Result &other, const Result &ours) const
{
    const std::size_t first = std::max(first_measured(other), first_measured(ours));
    const std::size_t end = std::min(other.ticks, ours.ticks);
    const bool tick_by_tick = other.times.size() == other.clock_times.size() && !in_batches;
    if (!tick_by_tick || first + least_common_ticks > end)
    {
        return other.mean() / ours.mean();
    }
    return sum_of_ticks(other, first, end) / sum_of_ticks(ours, first, end);
}

Comparison compare(const Plan &plan, Findings &findings)
{
    const WorldFactory factory = factory_of(plan);
    Comparison comparison = compare_with(plan, factory, findings);
    if (measured_in_batches(plan.spec) && plan.world.empty())
    {
        time_in_batches(comparison, plan, factory);
    }
    return comparison;
}

std::shared_ptr<const Comparison> compare_once(const Plan &plan, Findings &findings)
{
    const auto &made = findings.comparisons();
    const auto found = std::find_if(made.begin(), made.end(), [&](const auto &one) { return covers(*one, plan); });
    if (found != made.end())
    {
        return *found;
    }
    auto comparison = std::make_shared<const Comparison>(compare(plan, findings));
    print(std::cout, *comparison);
    record(*comparison, findings);
    findings.keep(comparison);
    return comparison;
}

Comparison compare_single_ticks(const Plan &plan, Findings &findings)
{
    return compare_with(plan, factory_of(plan), findings);
}
} // namespace ode_predictive_space::benchmarks
