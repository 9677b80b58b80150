#include "tests/benchmarks/contenders/pair_hash.h"
#include "tests/benchmarks/contenders/statistics.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
TEST(Measures, PercentilesAreByNearestRank)
{
    std::vector<double> series(1000);
    std::iota(series.begin(), series.end(), 1.0);
    EXPECT_DOUBLE_EQ(mean(series), 500.5);
    EXPECT_EQ(percentile(series, 500), 500);
    EXPECT_EQ(percentile(series, 990), 990);
    EXPECT_EQ(percentile(series, 999), 999);
    EXPECT_EQ(percentile({7}, 1), 7);
}

TEST(Measures, AHashOfPairsNoticesAMissingAnotherOrADoubledPair)
{
    const std::uint64_t hash = hash_pairs({{0, 1}, {2, 3}});
    EXPECT_NE(hash, hash_pairs({{0, 1}}));
    EXPECT_NE(hash, hash_pairs({{0, 1}, {2, 4}}));
    EXPECT_NE(hash, hash_pairs({{0, 3}, {1, 2}}));
    EXPECT_NE(hash, hash_pairs({{0, 1}, {2, 3}, {2, 3}}));
    EXPECT_NE(hash_pairs({}), hash_pairs({{2, 3}, {2, 3}})) << "two of the same do not cancel";
    EXPECT_NE(hash_pairs({}), hash_pairs({{0, 0}}));
}
} // namespace
} // namespace ode_predictive_space::benchmarks
