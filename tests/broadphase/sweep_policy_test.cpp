#include "ode_predictive_space/broadphase/sweep/sweep_policy.h"

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
constexpr std::size_t objects = 1000;
constexpr int soon = 10;
constexpr int long_after = 2000;

// Ticks of failed prediction until sweeping begins; `soon` when it does not.
int ticks_until_sweeping(SweepPolicy &policy)
{
    for (int ticks = 1; ticks < soon; ++ticks)
        if (policy.prediction_fails(objects, objects))
            return ticks;
    return soon;
}

// Calm ticks until sweeping ends; `long_after` when it does not.
int ticks_until_prediction(SweepPolicy &policy)
{
    for (int ticks = 1; ticks < long_after; ++ticks)
        if (policy.calm_returns(true))
            return ticks;
    return long_after;
}

TEST(SweepPolicy, ToleratesASingleBadTick)
{
    SweepPolicy policy;
    for (int repetition = 0; repetition < 100; ++repetition)
    {
        EXPECT_FALSE(policy.prediction_fails(objects, objects)) << "an explosion is over after one tick";
        EXPECT_FALSE(policy.prediction_fails(0, objects));
    }
}

TEST(SweepPolicy, GivesUpOnASceneInWhichPredictionFails)
{
    SweepPolicy policy;
    EXPECT_LT(ticks_until_sweeping(policy), soon);
}

TEST(SweepPolicy, ToleratesAFewBrokenPredictions)
{
    SweepPolicy policy;
    for (int tick = 0; tick < 1000; ++tick)
        EXPECT_FALSE(policy.prediction_fails(objects / 20, objects));
    EXPECT_FALSE(policy.prediction_fails(0, 0)) << "an empty scene";
}

TEST(SweepPolicy, SweepsAsLongAsThereIsNoCalm)
{
    SweepPolicy policy;
    ASSERT_LT(ticks_until_sweeping(policy), soon);
    for (int tick = 0; tick < long_after; ++tick)
        EXPECT_FALSE(policy.calm_returns(tick % 2 == 0)) << "single calm ticks are not enough";
    EXPECT_LT(ticks_until_prediction(policy), soon);
}

TEST(SweepPolicy, AnyCalmEndsSweepingThatNewObjectsBegan)
{
    SweepPolicy policy;
    for (int repetition = 0; repetition < 3; ++repetition)
    {
        policy.begin_with_new_objects();
        EXPECT_FALSE(policy.calm_returns(false));
        EXPECT_TRUE(policy.calm_returns(true));
    }
}

TEST(SweepPolicy, AsksForMoreCalmEachTimeThatItDidNotLast)
{
    SweepPolicy policy;
    int last = 0;
    for (int repetition = 0; repetition < 20; ++repetition)
    {
        ASSERT_LT(ticks_until_sweeping(policy), soon);
        const int calm = ticks_until_prediction(policy);
        EXPECT_TRUE(repetition == 0 || calm == 2 * last || calm == last) << "after " << last << " came " << calm;
        last = calm;
    }
    EXPECT_GT(last, soon);
    EXPECT_LE(last, 1024) << "prediction must get another chance before long";
}

TEST(SweepPolicy, ForgetsOldFailuresOnceCalmHasLasted)
{
    SweepPolicy policy;
    ASSERT_LT(ticks_until_sweeping(policy), soon);
    const int first = ticks_until_prediction(policy);
    ASSERT_LT(ticks_until_sweeping(policy), soon);
    ASSERT_GT(ticks_until_prediction(policy), first);
    for (int tick = 0; tick < long_after; ++tick)
        policy.prediction_fails(0, objects);
    ASSERT_LT(ticks_until_sweeping(policy), soon);
    EXPECT_EQ(ticks_until_prediction(policy), first);
}
} // namespace
} // namespace ode_predictive_space
