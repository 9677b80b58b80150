// Compares our declarations of ODE's internal classes with those in ODE's source.

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

TEST(Layout, OfVirtualFunctionsIsSeen)
{
    const LayoutFacts ours = facts_of_our_header();
    const long slot = sizeof(void *);
    EXPECT_EQ(ours.at("dxGeom::controlGeometry()"), 2 * slot) << "behind the two destructors";
    EXPECT_EQ(ours.at("dxSpace::collide2()"), 11 * slot) << "the last";
    EXPECT_EQ(ours.at("dxGeom::computePosr()"), -1) << "not virtual";
}
} // namespace
