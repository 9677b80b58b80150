#include "ode_predictive_space/haptics/exchange.h"

#include <gtest/gtest.h>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int many = 200000;

/// All its numbers are equal, so that half a value shows.
struct Wide
{
    std::array<int, 32> numbers{};
    bool whole() const
    {
        for (const int number : numbers)
            if (number != numbers[0])
                return false;
        return true;
    }
};

TEST(Snapshot, BetweenThreadsValuesAreWholeAndNeverGoBack)
{
    Snapshot<Wide> snapshot;
    std::thread writer([&] {
        for (int value = 1; value <= many; ++value)
        {
            snapshot.draft().numbers.fill(value);
            snapshot.publish();
        }
    });
    int last = 0;
    while (last < many)
    {
        if (!snapshot.take())
        {
            std::this_thread::yield();
            continue;
        }
        const Wide &seen = snapshot.latest();
        ASSERT_TRUE(seen.whole());
        ASSERT_GT(seen.numbers[0], last);
        last = seen.numbers[0];
    }
    writer.join();
}

TEST(Queue, RefusesWhatItHasNoRoomFor)
{
    Queue<int> queue(2);
    EXPECT_EQ(queue.room(), 2U);
    EXPECT_TRUE(queue.give(1));
    EXPECT_TRUE(queue.give(2));
    EXPECT_EQ(queue.room(), 0U);
    EXPECT_FALSE(queue.give(3));
    int value = 0;
    EXPECT_TRUE(queue.receive(value));
    EXPECT_EQ(value, 1);
    EXPECT_EQ(queue.room(), 1U);
    EXPECT_TRUE(queue.receive(value));
    EXPECT_EQ(value, 2);
    EXPECT_FALSE(queue.receive(value));
    EXPECT_EQ(value, 2) << "left alone";
}

TEST(Queue, BetweenThreadsNothingIsLostAndTheOrderIsKept)
{
    Queue<int> queue(16);
    std::thread giver([&] {
        for (int value = 1; value <= many;)
            if (queue.give(value))
                ++value;
            else
                std::this_thread::yield();
    });
    for (int expected = 1; expected <= many;)
    {
        int value = 0;
        if (!queue.receive(value))
        {
            std::this_thread::yield();
            continue;
        }
        ASSERT_EQ(value, expected);
        ++expected;
    }
    giver.join();
}
} // namespace
} // namespace ode_predictive_space::haptics
