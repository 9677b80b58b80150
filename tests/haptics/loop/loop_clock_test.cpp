#include "ode_predictive_space/haptics/loop.h"

#include <atomic>
#include <gtest/gtest.h>
#include <string>

namespace ode_predictive_space::haptics
{
namespace
{
TEST(SimulatedClock, ATaskThatTakesLongLeavesOutWhatItMissed)
{
    SimulatedClock clock;
    int slow = 0;
    int other = 0;
    const auto late = clock.start({1, {}, [&](double) {
                                       ++slow;
                                       clock.advance(2.5);
                                   }});
    const auto quick = clock.start({1, {}, [&](double) { ++other; }});
    clock.sleep_until(4); // due at 1, done at 3.5; due at 4
    EXPECT_EQ(slow, 2);
    EXPECT_EQ(other, 6) << "at 1, 2 and 3, while the slow one was at it, at 4, and at 5 and 6, before that ended again";
    EXPECT_EQ(clock.now(), 6.5);
}

TEST(SimulatedClock, TasksThatAreDueAtOnceRunInTheOrderOfTheirStarts)
{
    SimulatedClock clock;
    std::string order;
    const auto first = clock.start({1, {}, [&](double) { order += 'a'; }});
    const auto second = clock.start({1, {}, [&](double) { order += 'b'; }});
    clock.advance(2);
    EXPECT_EQ(order, "abab");
    clock.sleep_until(1);
    EXPECT_EQ(clock.now(), 2) << "it never goes back";
}

TEST(MonotonicClock, SleepsUntilADeadlineAndNotLess)
{
    MonotonicClock clock;
    const double deadline = clock.now() + 0.003;
    clock.sleep_until(deadline);
    EXPECT_GE(clock.now(), deadline);
    clock.sleep_until(deadline - 1);
}

TEST(MonotonicClock, ATaskHasAThreadOfItsOwnUntilItEnds)
{
    MonotonicClock clock;
    std::atomic<int> times{0};
    std::atomic<bool> prepared{false};
    std::atomic<bool> before{false};
    auto task = clock.start({0.001, [&] { prepared = true; },
                             [&](double) {
                                 before = before || !prepared;
                                 ++times;
                             }});
    while (times < 5)
        clock.sleep_until(clock.now() + 0.001);
    task.reset();
    const int last = times;
    clock.sleep_until(clock.now() + 0.005);
    EXPECT_EQ(times, last);
    EXPECT_FALSE(before);
}
} // namespace
} // namespace ode_predictive_space::haptics
