#include "demos/runs/statistics.h"

#include <gtest/gtest.h>
#include <numeric>

namespace ode_predictive_space::worlds
{
namespace
{
TEST(Statistics, OfTheNumbersFromOneToThousand)
{
    std::vector<double> series(1000);
    std::iota(series.rbegin(), series.rend(), 1.0);
    const Statistics result = summarise(series);
    EXPECT_DOUBLE_EQ(result.mean, 500.5);
    EXPECT_EQ(result.median, 500);
    EXPECT_EQ(result.p99, 990);
    EXPECT_EQ(result.p999, 999);
    EXPECT_EQ(result.max, 1000);
}

TEST(Statistics, OfAHundredNumbersTheWorstIsAboveThe99thPercentile)
{
    std::vector<double> series(100);
    std::iota(series.begin(), series.end(), 1.0);
    const Statistics result = summarise(series);
    EXPECT_EQ(result.p99, 99);
    EXPECT_EQ(result.p999, 100);
}

TEST(Statistics, OfOneNumberAndOfNone)
{
    const Statistics one = summarise({7});
    EXPECT_EQ(one.mean, 7);
    EXPECT_EQ(one.median, 7);
    EXPECT_EQ(one.p99, 7);
    EXPECT_EQ(one.max, 7);
    EXPECT_EQ(summarise({}).max, 0);
}
} // namespace
} // namespace ode_predictive_space::worlds
