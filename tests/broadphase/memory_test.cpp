#include "ode_predictive_space/broadphase/base/memory.h"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
using Half = std::array<std::uint8_t, 32>; // half a cache line
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

TEST(Memory, AnArrayThatShrinksGivesItsMemoryBack)
{
    std::vector<int> numbers;
    resize_array(numbers, 1000);
    numbers[3] = 7;
    resize_array(numbers, 4);
    EXPECT_EQ(bytes_of(numbers), 4 * sizeof(int));
    EXPECT_EQ(numbers.back(), 7);
}

TEST(Memory, ScratchGivesBackWhatAOneOffSpikeTook)
{
    std::vector<int> scratch(1000000);
    clear_scratch(scratch);
    scratch.assign(10, 1);
    clear_scratch(scratch);
    EXPECT_LE(bytes_of(scratch), 100000u);
}
} // namespace
} // namespace ode_predictive_space
