#include "demos/runs/pair_hash.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::worlds
{
namespace
{
TEST(PairHash, NoticesAMissingAnotherOrADoubledPair)
{
    const std::uint64_t hash = hash_pairs({{0, 1}, {2, 3}});
    EXPECT_NE(hash, hash_pairs({{0, 1}}));
    EXPECT_NE(hash, hash_pairs({{0, 1}, {2, 4}}));
    EXPECT_NE(hash, hash_pairs({{0, 3}, {1, 2}}));
    EXPECT_NE(hash, hash_pairs({{0, 1}, {2, 3}, {2, 3}}));
    EXPECT_NE(hash_pairs({}), hash_pairs({{2, 3}, {2, 3}})) << "two of the same do not cancel";
    EXPECT_NE(hash_pairs({}), hash_pairs({{0, 0}}));
}
} // namespace
} // namespace ode_predictive_space::worlds
