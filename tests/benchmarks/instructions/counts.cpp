#include "tests/benchmarks/instructions/counts.h"

#include "demos/runs/table.h"
#include "tests/benchmarks/comparison.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

bool same_scene(const Count &one, const Count &other)
{
    return one.scene == other.scene && one.objects == other.objects;
}

void check_comparable(const Count &before, const Count &now)
{
    if (before.seed != now.seed || before.ticks != now.ticks || before.warm_up_ticks != now.warm_up_ticks)
    {
        throw std::runtime_error(title_of(now) + " was counted over other ticks or with another seed before");
    }
}

std::vector<std::string> spaces_of(const std::vector<CountPair> &pairs)
{
    std::vector<std::string> spaces;
    for (const CountPair &pair : pairs)
    {
        if (std::find(spaces.begin(), spaces.end(), pair.now.space) == spaces.end())
        {
            spaces.push_back(pair.now.space);
        }
    }
    return spaces;
}

std::vector<CountPair> of_space(const std::vector<CountPair> &pairs, const std::string &space)
{
    std::vector<CountPair> result;
    std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(result),
                 [&](const CountPair &pair) { return pair.now.space == space; });
    return result;
}
} // namespace

nlohmann::json record_of(const CountedScene &counted, const std::string &kind)
{
    return {{"count", kind},
            {"scene", counted.scene},
            {"n", counted.objects},
            {"seed", counted.seed},
            {"warm_up_ticks", counted.warm_up_ticks},
            {"ticks", counted.ticks},
            {"space", counted.space}};
}

std::string title_of(const CountedScene &counted)
{
    return counted.scene + " " + grouped(static_cast<std::uint64_t>(counted.objects));
}

nlohmann::json record_of(const Count &count)
{
    nlohmann::json record = record_of(count, "instructions");
    record.update({{"collide", count.collide},
                   {"notices", count.notices},
                   {"sum", count.sum()},
                   {"pairs", count.pairs},
                   {"pair_hash", count.pair_hash}});
    if (count.life)
    {
        record["life"] = *count.life;
    }
    if (count.bytes_per_geom)
    {
        record["bytes_per_geom"] = *count.bytes_per_geom;
    }
    if (count.misses)
    {
        record.update(
            {{"first_level_misses", count.misses->first_level}, {"last_level_misses", count.misses->last_level}});
    }
    return record;
}

namespace
{
Count count_in(const nlohmann::json &record)
{
    Count count{{record.at("scene"), record.at("n"), record.at("seed"), record.at("warm_up_ticks"), record.at("ticks"),
                 record.at("space")},
                record.at("collide"),
                record.at("notices")};
    count.pairs = record.at("pairs");
    count.pair_hash = record.at("pair_hash");
    if (record.contains("life"))
    {
        count.life = record.at("life");
    }
    if (record.contains("bytes_per_geom"))
    {
        count.bytes_per_geom = record.at("bytes_per_geom");
    }
    if (record.contains("first_level_misses"))
    {
        count.misses = CacheMisses{record.at("first_level_misses"), record.at("last_level_misses")};
    }
    return count;
}
} // namespace

std::vector<Count> counts_in(const nlohmann::json &records)
{
    std::vector<Count> counts;
    for (const nlohmann::json &record : records.get<nlohmann::json::array_t>())
    {
        if (record.value("count", "") == "instructions")
        {
            counts.push_back(count_in(record));
        }
    }
    return counts;
}

const Count *best_of_ode(const std::vector<Count> &counts, const Count &in_scene_of)
{
    const Count *best = nullptr;
    for (const Count &count : counts)
    {
        const bool is_odes = std::find(ode_spaces().begin(), ode_spaces().end(), count.space) != ode_spaces().end();
        if (is_odes && same_scene(count, in_scene_of) && (best == nullptr || count.sum() < best->sum()))
        {
            best = &count;
        }
    }
    return best;
}

std::vector<CountPair> in_both(const std::vector<Count> &before, const std::vector<Count> &now)
{
    std::vector<CountPair> pairs;
    for (const Count &count : now)
    {
        const auto partner = std::find_if(before.begin(), before.end(), [&](const Count &other) {
            return same_scene(count, other) && count.space == other.space;
        });
        if (partner != before.end())
        {
            check_comparable(*partner, count);
            pairs.push_back({*partner, count});
        }
    }
    if (pairs.empty())
    {
        throw std::runtime_error("the two runs have no scene and space in common");
    }
    return pairs;
}

RatioSummary summary_of(const std::vector<CountPair> &pairs)
{
    RatioSummary summary;
    summary.largest = 0;
    double logarithms = 0;
    for (const CountPair &pair : pairs)
    {
        logarithms += std::log(pair.ratio());
        if (pair.ratio() > summary.largest)
        {
            summary.largest = pair.ratio();
            summary.largest_in = title_of(pair.now);
        }
    }
    summary.geometric_mean = std::exp(logarithms / static_cast<double>(pairs.size()));
    return summary;
}

namespace
{
/// Best ODE space over ours, of the sums, over all scenes.
void print_ratios(std::ostream &out, const std::vector<Count> &counts)
{
    std::vector<CountPair> pairs;
    for (const Count &count : counts)
    {
        const Count *best = best_of_ode(counts, count);
        if (count.space == "predictive-box" && best != nullptr)
        {
            pairs.push_back({count, *best});
        }
    }
    if (!pairs.empty())
    {
        out << "collide + notices, best ODE / predictive-box: geometric mean "
            << fixed(summary_of(pairs).geometric_mean, 2) << "\n\n";
    }
}
} // namespace

void print(std::ostream &out, const std::vector<Count> &counts)
{
    out << "Instructions per tick\n\n";
    Table table({"scene", "space", "collide", "notices", "life", "sum", "best ODE / this", "misses", "of last level",
                 "bytes per geom", "ticks", "pairs", "pair hash"});
    for (const Count &count : counts)
    {
        const Count *best = best_of_ode(counts, count);
        table.add({title_of(count), count.space, fixed(count.collide, 1), fixed(count.notices, 1),
                   count.life ? fixed(*count.life, 1) : "-", fixed(count.sum(), 1),
                   best != nullptr ? fixed(best->sum() / count.sum(), 2) : "-",
                   count.misses ? fixed(count.misses->first_level, 1) : "-",
                   count.misses ? fixed(count.misses->last_level, 1) : "-",
                   count.bytes_per_geom ? fixed(*count.bytes_per_geom, 0) : "-",
                   grouped(static_cast<std::uint64_t>(count.ticks)), grouped(count.pairs), count.pair_hash});
    }
    table.print(out);
    out << '\n';
    print_ratios(out, counts);
}

void print(std::ostream &out, const std::vector<CountPair> &pairs)
{
    out << "Instructions per tick, before and now\n\n";
    Table table({"scene", "space", "collide before", "now", "notices before", "now", "sum before", "now",
                 "now / before", "pairs"});
    for (const CountPair &pair : pairs)
    {
        table.add({title_of(pair.now), pair.now.space, fixed(pair.before.collide, 1), fixed(pair.now.collide, 1),
                   fixed(pair.before.notices, 1), fixed(pair.now.notices, 1), fixed(pair.before.sum(), 1),
                   fixed(pair.now.sum(), 1), fixed(pair.ratio(), 4), pair.same_pairs() ? "same" : "OTHERS"});
    }
    table.print(out);
    out << '\n';
    for (const std::string &space : spaces_of(pairs))
    {
        const RatioSummary summary = summary_of(of_space(pairs, space));
        out << space << ": geometric mean " << fixed(summary.geometric_mean, 4) << ", largest "
            << fixed(summary.largest, 4) << " (" << summary.largest_in << ")\n";
    }
}
} // namespace ode_predictive_space::benchmarks
