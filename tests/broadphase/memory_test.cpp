#include "ode_predictive_space/broadphase/base/memory.h"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
using Half = std::array<std::uint8_t, 32>; // of a cache line
using Halves = std::vector<Half, CacheLineAllocator<Half>>;

bool begins_with_a_line(const Halves &halves)
{
    return reinterpret_cast<std::uintptr_t>(halves.data()) % 64 == 0;
}

TEST(Memory, AnArrayBeginsWithACacheLineHoweverLargeItGets)
{
    Halves halves;
    for (std::size_t count = 1; count < 100000; count += 1 + count / 3)
    {
        resize_array(halves, count);
        EXPECT_EQ(halves.size(), count);
        EXPECT_TRUE(begins_with_a_line(halves)) << count;
    }
    const Halves copy = halves;
    EXPECT_TRUE(begins_with_a_line(copy));
}

TEST(Memory, ANewElementIsEmptyAndTheOthersStay)
{
    std::vector<int> numbers = {7};
    resize_array(numbers, 100);
    EXPECT_EQ(numbers.front(), 7);
    EXPECT_EQ(numbers.back(), 0);
}

TEST(Memory, GrowthReservesAQuarterMoreAndNotTwiceAsMuch)
{
    std::vector<int> numbers;
    resize_array(numbers, 1000);
    EXPECT_EQ(numbers.capacity(), 1250u);
    EXPECT_EQ(bytes_of(numbers), 1250 * sizeof(int));
    resize_array(numbers, 1250);
    EXPECT_EQ(numbers.capacity(), 1250u);
}

TEST(Memory, AnArrayThatShrinksGivesItsMemoryBack)
{
    std::vector<int> numbers;
    resize_array(numbers, 1000);
    numbers[3] = 7;
    resize_array(numbers, 4);
    EXPECT_EQ(bytes_of(numbers), 4 * sizeof(int));
    EXPECT_EQ(numbers.back(), 7);
}

// Fills the array and empties it, as in a tick.
void use(std::vector<int> &scratch, std::size_t count)
{
    scratch.assign(count, 1);
    clear_scratch(scratch);
    ASSERT_TRUE(scratch.empty());
}

TEST(Memory, ScratchKeepsWhatItNeedsInEachTick)
{
    std::vector<int> scratch;
    use(scratch, 100 * tuning::kept_scratch);
    const std::size_t before = scratch.capacity();
    for (int tick = 0; tick < 10; ++tick)
        use(scratch, 20 * tuning::kept_scratch);
    EXPECT_EQ(scratch.capacity(), before);
}

TEST(Memory, ScratchGivesBackWhatAOneOffSpikeTook)
{
    std::vector<int> scratch;
    use(scratch, 100 * tuning::kept_scratch);
    use(scratch, 10);
    EXPECT_LE(scratch.capacity(), tuning::kept_scratch);
}

TEST(Memory, SmallScratchKeepsItsMemory)
{
    std::vector<int> scratch;
    use(scratch, tuning::kept_scratch);
    for (int tick = 0; tick < 10; ++tick)
        use(scratch, 1);
    EXPECT_EQ(scratch.capacity(), tuning::kept_scratch);
}
} // namespace
} // namespace ode_predictive_space
