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

} // namespace
} // namespace ode_predictive_space::worlds
