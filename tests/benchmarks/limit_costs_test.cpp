#include "tests/benchmarks/limit_costs.h"

#include <gtest/gtest.h>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

LimitCosts costs_of(const char *scene, int objects)
{
    const OdeSession ode;
    return measure_once({scene, objects, 3, 1}, SpaceKind::predictive);
}

TEST(LimitCosts, AreOfTheWorldsThatTheNamesMean)
{
    EXPECT_EQ(costs_of("spot", 50).pairs, 50u * 49 / 2);
    EXPECT_EQ(costs_of("planes-all", 50).pairs - costs_of("planes", 50).pairs, 50u * 49 / 2);
    EXPECT_GE(costs_of("planes", 50).pairs, 50u * 100);
    EXPECT_EQ(costs_of("planes-apart", 50).pairs, costs_of("planes", 50).pairs);
    EXPECT_GE(costs_of("huge", 50).pairs, 50u);
    EXPECT_EQ(costs_of("nested", 50).pairs, costs_of("beside", 50).pairs);
    EXPECT_EQ(limit_world("many").name, "gas");
    EXPECT_THROW(limit_world("small"), std::invalid_argument);
}

TEST(LimitCosts, AreOfTheMiddleOfTheRoundsInTheOrderOfTheSpaces)
{
    const OdeSession ode;
    const std::vector<LimitCosts> costs =
        measure_by_turns({"far", 20, 3, 3}, {SpaceKind::simple, SpaceKind::predictive});
    ASSERT_EQ(costs.size(), 2u);
    EXPECT_EQ(costs[0].pair_hash, costs[1].pair_hash);
    EXPECT_GT(costs[1].heap, costs[0].heap);
    EXPECT_GE(costs[1].collide, 0);
    EXPECT_GT(measure_once({"far", 20, 3, 1}, SpaceKind::predictive).heap,
              measure_once({"far", 20, 3, 1}, SpaceKind::predictive, false).heap);
}
} // namespace
} // namespace ode_predictive_space::benchmarks
