#include "ode_predictive_space/preload/counts.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "ode_predictive_space/preload/report.h"

namespace ode_predictive_space::preload
{
namespace
{
double median_of(const std::vector<double> &seconds)
{
    Durations durations{};
    for (double each : seconds)
        durations.add(each);
    return durations.median();
}

TEST(Durations, MedianIsThatOfTheValues)
{
    EXPECT_EQ(median_of({}), 0);
    for (double value = 3.3e-8; value < 4.2; value *= 1.07)
    {
        EXPECT_NEAR(median_of({value}), value, value / 32) << value;
        EXPECT_NEAR(median_of({9 * value, value / 7, value, value / 3, 2 * value}), value, value / 32) << value;
    }
}

TEST(Durations, ShortOnesAreToldApartByNanoseconds)
{
    for (int nanoseconds = 0; nanoseconds < 32; ++nanoseconds)
        EXPECT_NEAR(median_of({1e-9 * nanoseconds + 1e-10}), 1e-9 * nanoseconds, 0.6e-9) << nanoseconds;
}

TEST(Durations, NeedNotBeSensible)
{
    EXPECT_LT(median_of({-1.0}), 1.1e-9);
    EXPECT_NEAR(median_of({1e30}), 4.29, 4.29 / 16);
    EXPECT_NEAR(median_of({std::numeric_limits<double>::infinity()}), 4.29, 4.29 / 16);
    EXPECT_LT(median_of({std::numeric_limits<double>::quiet_NaN()}), 4.3);
}

TEST(CallTimes, AddUp)
{
    CallTimes times{};
    times.add(2e-6, 5e-6);
    times.add(1e-6, 1e-6);
    EXPECT_EQ(times.calls, 2u);
    EXPECT_DOUBLE_EQ(times.total, 3e-6);
    EXPECT_DOUBLE_EQ(times.largest, 2e-6);
    EXPECT_DOUBLE_EQ(times.in_callbacks, 6e-6);
}

TEST(Report, HasALineForEachSpaceAndOneForTheComparison)
{
    Settings settings;
    settings.stats = settings.compare = true;
    SpaceCounts counts{};
    counts.number = 3;
    counts.compared = 2;
    counts.differences = 1;
    const std::string text = report_text(settings, "program\x1b", 7, {counts, counts});
    EXPECT_EQ(text.rfind("ode_predictive_space: program\\x1b (process 7)\n  space 3", 0), 0u) << text;
    EXPECT_NE(text.find("\n  compared with all pairs: 4 collides, 2 differences\n"), std::string::npos) << text;
}
} // namespace
} // namespace ode_predictive_space::preload
