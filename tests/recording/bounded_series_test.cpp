#include "ode_predictive_space/recording/bounded_series.h"

#include <cstring>
#include <gtest/gtest.h>

namespace ode_predictive_space::recording
{
namespace
{
constexpr std::size_t most = BoundedSeries::most_columns;

TEST(BoundedSeries, MergesNeighboursWhenItIsFull)
{
    BoundedSeries series{};
    for (std::size_t i = 0; i < 2 * most + 1; ++i)
    {
        series.add(static_cast<double>(i));
    }
    ASSERT_EQ(series.values_per_column(), 4u);
    ASSERT_EQ(series.columns(), most / 2 + 1);
    EXPECT_EQ(series.mean(0), 1.5);
    EXPECT_EQ(series.largest(0), 3);
    EXPECT_EQ(series.mean(most / 2 - 1), 2 * most - 2.5);
    EXPECT_EQ(series.mean(most / 2), 2 * most) << "the last column has one value";
}

TEST(BoundedSeries, StaysWithinItsColumnsWhateverTheMemoryHolds)
{
    BoundedSeries series;
    std::memset(static_cast<void *>(&series), 0xff, sizeof series);
    EXPECT_LE(series.columns(), most);
    for (std::size_t i = 0; i < series.columns(); ++i)
    {
        series.mean(i);
    }
    series.add(1);
    EXPECT_LE(series.columns(), most);
}
} // namespace
} // namespace ode_predictive_space::recording
