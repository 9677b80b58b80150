#include "ode_predictive_space/haptics/loop/time_histogram.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace ode_predictive_space::haptics
{
namespace
{
TEST(TimeHistogram, QuantilesAreNeverTooShortAndTooLongByLessThanTwoPercent)
{
    std::mt19937 random(1);
    std::lognormal_distribution<double> times(std::log(1e-3), 2);
    std::vector<double> all(10000);
    TimeHistogram histogram;
    for (double &time : all)
    {
        time = times(random);
        histogram.add(time);
    }
    std::sort(all.begin(), all.end());
    for (const double share : {0.001, 0.1, 0.5, 0.9, 0.99, 0.999, 1.0})
    {
        const double truth = all[static_cast<std::size_t>(std::ceil(share * 10000)) - 1];
        EXPECT_GE(histogram.quantile(share), truth * (1 - 1e-12)) << share;
        EXPECT_LE(histogram.quantile(share), truth * 1.02) << share;
    }
    EXPECT_EQ(histogram.summary().max, all.back());
    EXPECT_EQ(histogram.summary().count, 10000U);
}

TEST(TimeHistogram, ClampsTimesToItsRange)
{
    TimeHistogram histogram;
    histogram.add(1e9);
    EXPECT_EQ(histogram.quantile(1), 1e4);
    histogram.add(0);
    EXPECT_NEAR(histogram.quantile(0.5), 1e-9, 2e-11);
}

TEST(TimeHistogram, MeanIsExact)
{
    TimeHistogram histogram;
    histogram.add(0.25);
    histogram.add(0.75);
    EXPECT_DOUBLE_EQ(histogram.summary().mean, 0.5);
}
} // namespace
} // namespace ode_predictive_space::haptics
