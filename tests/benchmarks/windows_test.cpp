#include "tests/benchmarks/windows.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
TEST(Windows, DivideTheMeasuredTicks)
{
    Comparison whole;
    whole.results.resize(2);
    whole.results[0].times = {1, 2, 3, 4, 5};
    whole.results[0].clock_times = whole.results[0].times;
    whole.results[0].tick_times = {10, 20, 30, 40, 50};
    whole.results[0].ticks = 7; // two of them warm-up
    whole.results[0].pairs = 99;
    whole.results[1].times = whole.results[1].clock_times = whole.results[1].tick_times = {6, 7, 8};
    whole.results[1].ticks = 5;
    const std::vector<Comparison> windows = windows_of(whole, 2);
    ASSERT_EQ(windows.size(), 3u);
    EXPECT_EQ(windows[1].results[0].times, (std::vector<double>{3, 4}));
    EXPECT_EQ(windows[1].results[0].tick_times, (std::vector<double>{30, 40}));
    EXPECT_EQ(windows[1].results[0].ticks, 6u) << "up to the end of the window";
    EXPECT_EQ(windows[1].results[0].pairs, 99u) << "of the whole run";
    EXPECT_EQ(windows[1].results[1].times, (std::vector<double>{8}));
    EXPECT_EQ(windows[2].results[0].times, (std::vector<double>{5}));
    EXPECT_TRUE(windows[2].results[1].times.empty()) << "it was stopped before";
}
} // namespace
} // namespace ode_predictive_space::benchmarks
