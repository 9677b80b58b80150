// The haptic loop and the search for the most objects that it can have.

#include "tests/benchmarks/haptic_measurement.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
using worlds::SpaceKind;

TEST(HapticLoop, TheProbeFeelsTheSameInEverySpaceAndWhateverTheTickContains)
{
    const worlds::OdeSession ode;
    for (const HapticTick tick : all_haptic_ticks)
    {
        std::vector<double> forces;
        for (const SpaceKind kind : worlds::all_spaces())
        {
            HapticLoop loop(kind, 300, 1, tick);
            for (int i = 0; i < 2000; ++i)
            {
                EXPECT_GE(loop.tick(), 0);
            }
            EXPECT_GT(loop.ticks_in_touch(), 10u) << haptic_tick_name(tick);
            EXPECT_LT(loop.ticks_in_touch(), 2000u) << haptic_tick_name(tick);
            forces.push_back(loop.force_sum());
            EXPECT_EQ(forces.back(), forces.front()) << haptic_tick_name(tick) << ", " << space_name(kind);
        }
    }
}

HapticSettings short_search()
{
    HapticSettings settings;
    settings.ticks = 20;
    settings.first = 40;
    settings.most = 320;
    return settings;
}

TEST(HapticMeasurement, WithoutADeadlineAllThatIsAllowedKeeps)
{
    const worlds::OdeSession ode;
    HapticSettings settings = short_search();
    settings.deadline = 1e12;
    const HapticResult result = most_objects(SpaceKind::predictive, settings);
    EXPECT_EQ(result.objects, 320);
    EXPECT_TRUE(result.at_most.kept);
    EXPECT_EQ(result.kept, (std::vector<int>{40, 80, 160, 320}));
    EXPECT_EQ(result.forces.size(), result.kept.size());
}

TEST(HapticMeasurement, WhatNothingCanKeepIsTriedTwiceDownToOneObject)
{
    const worlds::OdeSession ode;
    HapticSettings settings = short_search();
    settings.deadline = -1;
    std::vector<int> tried;
    const HapticResult result = most_objects(SpaceKind::hash, settings, [&](int objects) { tried.push_back(objects); });
    EXPECT_EQ(result.objects, 0);
    EXPECT_EQ(tried, (std::vector<int>{40, 40, 20, 20, 10, 10, 5, 5, 2, 2, 1, 1}));
}

TEST(HapticMeasurement, ATrialEndsWhenTooManyTicksWereLate)
{
    const worlds::OdeSession ode;
    HapticSettings settings;
    settings.deadline = -1;
    settings.ticks = 1000;
    EXPECT_FALSE(try_haptic_loop(SpaceKind::simple, 10, settings).kept);
    settings.in_time = 0;
    EXPECT_TRUE(try_haptic_loop(SpaceKind::simple, 10, settings).kept) << "any number may be late";
}

TEST(HapticMeasurement, ComparesForcesWhereTheNumbersOfObjectsAreTheSame)
{
    const HapticResult first{SpaceKind::predictive, 200, {}, {100, 200}, {1.5, 2.5}};
    const HapticResult same{SpaceKind::hash, 100, {}, {100, 120}, {1.5, 9}};
    const HapticResult other{SpaceKind::simple, 100, {}, {50, 100}, {1.5, 1.25}};
    EXPECT_TRUE(same_forces({first, same}));
    EXPECT_FALSE(same_forces({first, same, other}));
    EXPECT_DOUBLE_EQ(haptic_ratio({first, same, other}, first), 2);
    EXPECT_EQ(haptic_ratio({first}, first), 0) << "nothing to compare with";
}

} // namespace
} // namespace ode_predictive_space::benchmarks
