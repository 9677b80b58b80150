// Queries: the same answers everywhere, and what is made of their times.

#include "tests/benchmarks/query_measurement.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
using worlds::SpaceKind;

QuerySettings small_query()
{
    QuerySettings settings;
    settings.objects = 300;
    settings.ticks = 50;
    settings.spaces = worlds::all_spaces();
    return settings;
}

TEST(QueryMeasurement, AllSpacesFindTheSame)
{
    const worlds::OdeSession ode;
    for (const auto &[collide_first, still] : {std::pair(true, false), std::pair(false, false), std::pair(false, true)})
    {
        QuerySettings settings = small_query();
        settings.collide_first = collide_first;
        settings.still = still;
        settings.check = true;
        const std::vector<QueryResult> results = measure_queries(settings);
        ASSERT_EQ(results.size(), 5u);
        EXPECT_TRUE(same_pairs(results));
        EXPECT_TRUE(all_valid(results));
        for (const QueryResult &result : results)
        {
            EXPECT_EQ(result.spheres.times.size(), 50u);
            EXPECT_EQ(result.rays.times.size(), 50u);
            EXPECT_GT(result.spheres.pairs, 0u) << space_name(result.space);
            EXPECT_GT(result.rays.pairs, result.spheres.pairs) << space_name(result.space);
        }
    }
}

TEST(QueryMeasurement, NoticesAPairTooFewAndASpaceThatIsNotExact)
{
    QueryResult right{SpaceKind::simple, true, true, {{}, 5, 111}, {{}, 5, 222}};
    QueryResult wrong_rays = right;
    wrong_rays.rays.pair_hash = 333;
    EXPECT_TRUE(same_pairs({right, right}));
    EXPECT_FALSE(same_pairs({right, wrong_rays}));
    wrong_rays.exact = false;
    EXPECT_TRUE(same_pairs({wrong_rays, right, right})) << "it need not report the same pairs";
    QueryResult invalid = right;
    invalid.valid = false;
    EXPECT_FALSE(all_valid({right, invalid}));
}

TEST(QueryMeasurement, RatioIsThatToTheFastestOfTheOthers)
{
    const std::vector<QueryResult> results = {{SpaceKind::predictive, true, true, {{1, 3}, 0, 0}, {}},
                                              {SpaceKind::hash, true, true, {{20, 20}, 0, 0}, {}},
                                              {SpaceKind::simple, true, true, {{50, 30}, 0, 0}, {}}};
    EXPECT_DOUBLE_EQ(query_ratio(results, {SpaceKind::simple, SpaceKind::hash}, &QueryResult::spheres), 10);
    EXPECT_DOUBLE_EQ(query_ratio(results, {SpaceKind::hash, SpaceKind::simple}, &QueryResult::spheres), 10);
    EXPECT_DOUBLE_EQ(query_ratio(results, {SpaceKind::simple}, &QueryResult::spheres), 20);
    EXPECT_EQ(query_ratio(results, {SpaceKind::quadtree}, &QueryResult::spheres), 0) << "not measured";
}

TEST(QueryMeasurement, RecordsSayWhatWasAsked)
{
    const worlds::OdeSession ode;
    QuerySettings settings = small_query();
    settings.spaces = {SpaceKind::predictive};
    const nlohmann::json records = query_records(measure_queries(settings), settings);
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[0]["what"], "spheres");
    EXPECT_EQ(records[1]["what"], "rays");
    for (const char *field : {"scene", "n", "space", "seed", "ticks", "mean_us", "median_us", "p99_us", "p999_us",
                              "max_us", "pairs", "pair_hash"})
    {
        EXPECT_TRUE(records[0].contains(field)) << field;
    }
}

} // namespace
} // namespace ode_predictive_space::benchmarks
