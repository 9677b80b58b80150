// Comparisons for people and for other programs.

#include "tests/benchmarks/comparison.h"

#include "demos/runs/table.h"
#include "tests/benchmarks/batches.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

/// How many times as fast as the best of ODE's spaces; not a number when there is none.
double ratio_to_best(const Comparison &comparison, const Result &result)
{
    const Result *best = comparison.best_of_ode();
    return best == nullptr ? std::numeric_limits<double>::quiet_NaN() : comparison.ratio(*best, result);
}

nlohmann::json number_or_null(double number)
{
    return std::isfinite(number) ? nlohmann::json(number) : nlohmann::json(nullptr);
}
} // namespace

void print(std::ostream &out, const Comparison &comparison)
{
    out << comparison.spec.name << ", n = " << grouped(static_cast<std::uint64_t>(comparison.spec.objects)) << ", seed "
        << comparison.spec.seed << "; microseconds in dSpaceCollide() per tick"
        << (comparison.in_batches ? ", means of batches of " + std::to_string(ticks_per_batch) + " ticks" : "")
        << "\n\n";
    Table table({"space", "mean", "median", "p99", "p99.9", "max", "ticks", "pairs", "pair hash", "best ODE / this"});
    for (const Result &result : comparison.results)
    {
        const Statistics times = summarise(result.times);
        const double ratio = ratio_to_best(comparison, result);
        table.add({result.name, fixed(times.mean, 2), fixed(times.median, 2), fixed(times.p99, 2), fixed(times.p999, 2),
                   fixed(times.max, 2), grouped(result.ticks), grouped(result.pairs), hexadecimal(result.pair_hash),
                   std::isfinite(ratio) ? fixed(ratio, 2) : "-"});
    }
    table.print(out);
    out << '\n';
    out.flush();
}

void record(const Comparison &comparison, Findings &findings)
{
    for (const Result &result : comparison.results)
    {
        const Statistics times = summarise(result.times);
        const std::size_t measured = result.times.size() * (comparison.in_batches ? ticks_per_batch : 1);
        findings.record({{"scene", comparison.spec.name},
                         {"n", comparison.spec.objects},
                         {"space", result.name},
                         {"seed", comparison.spec.seed},
                         {"moving", number_or_null(comparison.spec.moving < 0 ? std::nan("") : comparison.spec.moving)},
                         {"ticks", result.ticks},
                         {"measured_ticks", measured},
                         {"in_batches", comparison.in_batches},
                         {"mean_us", times.mean},
                         {"median_us", times.median},
                         {"p99_us", times.p99},
                         {"p999_us", times.p999},
                         {"max_us", times.max},
                         {"pairs", result.pairs},
                         {"pair_hash", hexadecimal(result.pair_hash)},
                         {"false_pairs", result.false_pairs},
                         {"contacts", result.contacts},
                         {"bytes_per_geom", number_or_null(result.bytes_per_geom)},
                         {"best_ode_ratio", number_or_null(ratio_to_best(comparison, result))}});
    }
}
} // namespace ode_predictive_space::benchmarks
