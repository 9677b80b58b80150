#include <gtest/gtest.h>

#include "tests/layout/facts.h"

namespace
{
TEST(Layout, IsThatOfOdesSource)
{
    const LayoutFacts ours = facts_of_our_header();
    for (const auto &[name, value] : facts_of_odes_headers())
    {
        ASSERT_EQ(ours.count(name), 1u) << name;
        EXPECT_EQ(ours.at(name), value) << name;
    }
}
} // namespace
