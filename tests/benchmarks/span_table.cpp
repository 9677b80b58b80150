#include "tests/benchmarks/span_table.h"

#include "demos/runs/table.h"

#include <cmath>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

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
    std::cout << "; microseconds in " << span.calls << " per tick\n\n";
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
        findings.record({{"table", span.table},
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

} // namespace

double collide_ratio(const Comparison &comparison, const std::string &space)
{
    const Result *result = comparison.find(space);
    return result != nullptr ? collide_ratio(comparison, *result) : std::nan("");
}

double tick_ratio(const Comparison &comparison, const std::string &space)
{
    const Result *result = comparison.find(space);
    return result != nullptr ? tick_ratio(comparison, *result) : std::nan("");
}

void show(const Span &span, const Comparison &comparison, Findings &findings)
{
    print(span, comparison);
    record(span, comparison, findings);
}
} // namespace ode_predictive_space::benchmarks
