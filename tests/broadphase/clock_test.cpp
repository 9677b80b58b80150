#include "ode_predictive_space/broadphase/base/clock.h"

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
// Ten objects that were predicted to move, of a hundred.
class ClockTest : public testing::Test
{
protected:
    ClockTest()
    {
        moving_.resize(objects);
        for (ProxyId id = 60; id < 70; ++id)
            moving_.insert(id);
    }

    // The first so many of them have moved since the last update.
    bool tick(ProxyId count) { return update(true, count); }
    bool question(ProxyId count) { return update(false, count); }

    // One that was predicted to stay where it is has moved.
    bool question_after_other_move() { return clock.advance(false, true, set_of({3}), moving_); }

    Clock clock;

private:
    static constexpr std::size_t objects = 100;

    bool update(bool is_tick, ProxyId count)
    {
        std::vector<ProxyId> ids;
        for (ProxyId id = 60; id < 60 + count; ++id)
            ids.push_back(id);
        return clock.advance(is_tick, count > 0, set_of(ids), moving_);
    }

    static IdSet set_of(const std::vector<ProxyId> &ids)
    {
        IdSet set;
        set.resize(objects);
        for (ProxyId id : ids)
            set.insert(id);
        return set;
    }

    IdSet moving_;
};

TEST_F(ClockTest, EachTickAfterAMovePassesTime)
{
    EXPECT_EQ(clock.now(), 0u);
    for (Tick now = 1; now < 10; ++now)
    {
        EXPECT_EQ(clock.expected(), now);
        EXPECT_TRUE(tick(1));
        EXPECT_EQ(clock.now(), now);
    }
}

TEST_F(ClockTest, WhileNothingMovesNoTimePasses)
{
    tick(10);
    for (int i = 0; i < 5; ++i)
    {
        EXPECT_FALSE(tick(0));
        EXPECT_FALSE(question(0));
    }
    EXPECT_EQ(clock.now(), 1u);
    EXPECT_EQ(clock.expected(), 2u);
}

TEST_F(ClockTest, AQuestionPassesTimeWhenHalfOfTheMovingObjectsHaveMoved)
{
    EXPECT_FALSE(question(4));
    EXPECT_FALSE(question_after_other_move());
    EXPECT_EQ(clock.now(), 0u);
    EXPECT_TRUE(question(5));
    EXPECT_EQ(clock.now(), 1u);
}

// The tick that follows the question belongs to the same step of the program.
TEST_F(ClockTest, TheTickAfterSuchAQuestionPassesNoTimeTwice)
{
    question(10);
    EXPECT_EQ(clock.expected(), 1u) << "the next tick is this one";
    EXPECT_FALSE(tick(2)) << "some were moved after the question";
    EXPECT_EQ(clock.now(), 1u);
    EXPECT_EQ(clock.expected(), 2u);
    EXPECT_TRUE(tick(2));
    EXPECT_EQ(clock.now(), 2u);
}

TEST_F(ClockTest, AQuestionThatPassesNoTimeLeavesTheTickItsOwn)
{
    question(1);
    EXPECT_EQ(clock.expected(), 1u);
    EXPECT_TRUE(tick(1));
    EXPECT_EQ(clock.now(), 1u);
}

// A program that steps, asks, and steps again before its tick.
TEST_F(ClockTest, AStepThatMovesMostPassesTimeAlsoAfterAQuestion)
{
    question(10);
    EXPECT_TRUE(question(10));
    EXPECT_TRUE(tick(10));
    EXPECT_EQ(clock.now(), 3u);
    EXPECT_EQ(clock.expected(), 4u);
}
} // namespace
} // namespace ode_predictive_space
