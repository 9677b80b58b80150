#include "tests/benchmarks/limits/limit_costs.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <ode_predictive_space/predictive_space.h>
#include <set>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace scenes;

class Limits : public testing::TestWithParam<std::string>
{
protected:
    OdeSession ode_;
};

std::string name_of(const testing::TestParamInfo<std::string> &info)
{
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

TEST_P(Limits, HaveThePairsOfASimpleSpace)
{
    for (const int objects : {1, 50})
    {
        const Limit limit{GetParam(), objects, 50, 1};
        const LimitCosts simple = measure_once(limit, SpaceKind::simple);
        const LimitCosts predictive = measure_once(limit, SpaceKind::predictive);
        EXPECT_EQ(predictive.pairs, simple.pairs) << objects;
        EXPECT_EQ(predictive.pair_hash, simple.pair_hash) << objects;
    }
}

TEST_P(Limits, KeepTheInvariantAndLeaveAnEmptySpace)
{
    const OwnedSpace space(dPredictiveSpaceCreate(nullptr));
    const auto scene = make_limit_scene(GetParam(), 50, SpaceKind::predictive, space.get());
    const auto ignore = [](void *, dGeomID, dGeomID) {};
    for (int tick = 0; tick < 50; ++tick)
    {
        scene->advance();
        scene->collide(nullptr, ignore);
        ASSERT_EQ(dPredictiveSpaceValidate(space.get()), 1) << tick;
    }
    EXPECT_GT(dSpaceGetNumGeoms(space.get()), 0);
    scene->empty();
    EXPECT_EQ(dSpaceGetNumGeoms(space.get()), 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Limits, testing::ValuesIn(limit_scene_names()), name_of);

LimitCosts costs_of(const char *scene, int objects)
{
    const OdeSession ode;
    return measure_once({scene, objects, 3, 1}, SpaceKind::predictive);
}

TEST(LimitScenes, AreWhatTheirNamesSay)
{
    EXPECT_EQ(costs_of("spot", 50).pairs, 50u * 49 / 2);
    EXPECT_EQ(costs_of("planes-all", 50).pairs - costs_of("planes", 50).pairs, 50u * 49 / 2);
    EXPECT_GE(costs_of("planes", 50).pairs, 50u * 100);
    EXPECT_EQ(costs_of("planes-apart", 50).pairs, costs_of("planes", 50).pairs);
    EXPECT_GE(costs_of("huge", 50).pairs, 50u);
    EXPECT_EQ(costs_of("nested", 50).pairs, costs_of("beside", 50).pairs);
}

TEST(LimitScenes, RefuseUnknownNames)
{
    const OdeSession ode;
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    EXPECT_THROW(make_limit_scene("small", 5, SpaceKind::simple, space.get()), std::invalid_argument);
    EXPECT_THROW(describe_limit_scene("small"), std::invalid_argument);
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
