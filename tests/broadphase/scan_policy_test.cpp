#include "ode_predictive_space/broadphase/scan_policy.h"

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
constexpr std::size_t objects = 1000;
constexpr int soon = 10;
constexpr int long_after = 2000;

// Ticks of failed prediction until scanning begins; `soon` when it does not.
int ticks_until_scanning(ScanPolicy &policy)
{
    for (int ticks = 1; ticks < soon; ++ticks)
        if (policy.prediction_fails(objects, objects))
            return ticks;
    return soon;
}

// Calm ticks until scanning ends; `long_after` when it does not.
int ticks_until_prediction(ScanPolicy &policy)
{
    for (int ticks = 1; ticks < long_after; ++ticks)
        if (policy.calm_returns(true))
            return ticks;
    return long_after;
}

TEST(ScanPolicy, StartsWithPrediction)
{
    EXPECT_FALSE(ScanPolicy().scanning());
}

TEST(ScanPolicy, ToleratesASingleBadTick)
{
    ScanPolicy policy;
    for (int repetition = 0; repetition < 100; ++repetition)
    {
        EXPECT_FALSE(policy.prediction_fails(objects, objects)) << "an explosion is over after one tick";
        EXPECT_FALSE(policy.prediction_fails(0, objects));
    }
    EXPECT_FALSE(policy.scanning());
}

TEST(ScanPolicy, GivesUpOnASceneInWhichPredictionFails)
{
    ScanPolicy policy;
    EXPECT_LT(ticks_until_scanning(policy), soon);
    EXPECT_TRUE(policy.scanning());
}

TEST(ScanPolicy, BearsWithAFewBrokenPredictions)
{
    ScanPolicy policy;
    for (int tick = 0; tick < 1000; ++tick)
        EXPECT_FALSE(policy.prediction_fails(objects / 20, objects));
    EXPECT_FALSE(policy.prediction_fails(0, 0)) << "an empty scene";
}

TEST(ScanPolicy, ScansAsLongAsThereIsNoCalm)
{
    ScanPolicy policy;
    ASSERT_LT(ticks_until_scanning(policy), soon);
    for (int tick = 0; tick < long_after; ++tick)
        EXPECT_FALSE(policy.calm_returns(tick % 2 == 0)) << "single calm ticks are not enough";
    EXPECT_TRUE(policy.scanning());
    EXPECT_LT(ticks_until_prediction(policy), soon);
    EXPECT_FALSE(policy.scanning());
}

TEST(ScanPolicy, AsksForMoreCalmEachTimeThatItDidNotLast)
{
    ScanPolicy policy;
    int last = 0;
    for (int repetition = 0; repetition < 20; ++repetition)
    {
        ASSERT_LT(ticks_until_scanning(policy), soon);
        const int calm = ticks_until_prediction(policy);
        EXPECT_TRUE(repetition == 0 || calm == 2 * last || calm == last) << "after " << last << " came " << calm;
        last = calm;
    }
    EXPECT_GT(last, soon);
    EXPECT_LE(last, 1024) << "prediction must get another chance before long";
}

TEST(ScanPolicy, ForgetsOldFailuresOnceCalmHasLasted)
{
    ScanPolicy policy;
    ASSERT_LT(ticks_until_scanning(policy), soon);
    const int first = ticks_until_prediction(policy);
    ASSERT_LT(ticks_until_scanning(policy), soon);
    ASSERT_GT(ticks_until_prediction(policy), first);
    for (int tick = 0; tick < long_after; ++tick)
        policy.prediction_fails(0, objects);
    ASSERT_LT(ticks_until_scanning(policy), soon);
    EXPECT_EQ(ticks_until_prediction(policy), first);
}
} // namespace
} // namespace ode_predictive_space
