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

INSTANTIATE_TEST_SUITE_P(Prefetch, LoopLength, testing::Values(0, 1, 3, 4, 5, 8, 9, 100),
                         testing::PrintToStringParamName());

} // namespace
} // namespace ode_predictive_space
