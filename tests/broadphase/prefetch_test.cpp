#include "ode_predictive_space/broadphase/base/prefetch.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
using Indices = std::vector<std::size_t>;

Indices all_up_to(std::size_t count)
{
    Indices indices;
    for (std::size_t i = 0; i < count; ++i)
        indices.push_back(i);
    return indices;
}

constexpr std::size_t distance = 4;

class LoopLength : public testing::TestWithParam<std::size_t>
{};

TEST_P(LoopLength, EachIndexIsVisitedOnceInOrder)
{
    Indices visited;
    for_each_prefetched(GetParam(), distance, [&](std::size_t i) { visited.push_back(i); });
    EXPECT_EQ(visited, all_up_to(GetParam()));
}

TEST_P(LoopLength, EachFetchComesBeforeTheNextOne)
{
    const std::size_t count = GetParam();
    Indices visited, first, second;
    for_each_prefetched(
        count, distance,
        [&](std::size_t i) {
            EXPECT_LT(i, second.size());
            visited.push_back(i);
        },
        [&](std::size_t i) { first.push_back(i); },
        [&](std::size_t i) {
            EXPECT_LT(i, first.size());
            second.push_back(i);
        });
    for (const Indices &called : {visited, first, second})
        EXPECT_EQ(called, all_up_to(count));
}

INSTANTIATE_TEST_SUITE_P(Prefetch, LoopLength, testing::Values(0, 1, 3, 4, 5, 8, 9, 100),
                         testing::PrintToStringParamName());

// So that memory has time to come, and is not pushed out again before it is read.
TEST(Prefetch, InALongLoopAFetchRunsAheadByTheDistance)
{
    for (std::size_t count : {5, 8, 9, 100})
    {
        std::size_t first = 0, second = 0;
        for_each_prefetched(
            count, distance,
            [&](std::size_t i) {
                EXPECT_EQ(second, std::min(i + distance + 1, count));
                EXPECT_EQ(first, std::min(i + 2 * distance + 1, count));
            },
            [&](std::size_t) { ++first; }, [&](std::size_t) { ++second; });
        EXPECT_EQ(first, count);
    }
}

// There is no time for memory to come during the loop: all fetches are on their way before the first visit.
TEST(Prefetch, InAShortLoopAllAreFetchedFirst)
{
    for (std::size_t count = 0; count <= distance; ++count)
    {
        std::size_t first = 0, second = 0;
        for_each_prefetched(
            count, distance, [&](std::size_t) { EXPECT_EQ(second, count); }, [&](std::size_t) { ++first; },
            [&](std::size_t) {
                EXPECT_EQ(first, count);
                ++second;
            });
        EXPECT_EQ(second, count);
    }
}

TEST(Prefetch, ReadsNothingAndMayBeGivenAnyAddress)
{
    prefetch(nullptr);
    prefetch_block<200>(nullptr);
    const char one = 0;
    prefetch_block<200>(&one);
}
} // namespace
} // namespace ode_predictive_space
