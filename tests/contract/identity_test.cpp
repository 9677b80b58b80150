#include <random>
#include <utility>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

#ifdef ODE_HAS_PREDICTIVE_SPACE
constexpr int expected_class = dPredictiveSpaceClass;
static_assert(dPredictiveSpaceClass == dLastSpaceClass && dFirstUserClass == dLastSpaceClass + 1,
              "it is a class of space");
static_assert(dQuadTreeSpaceClass == 13, "a program that was built for ODE without it knows its spaces by number");

TEST(InsideOde, TheConfigurationTellsThatItIsThere)
{
    EXPECT_EQ(dCheckConfiguration("ODE_EXT_predictive_space"), 1);
}
#else
constexpr int expected_class = dHashSpaceClass;
#endif

TEST_F(Contract, 17_TheClassIsThatOfAHashSpaceOrItsOwn)
{
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    EXPECT_EQ(dSpaceGetClass(space), expected_class);
    EXPECT_EQ(dGeomGetClass(as_geom(space)), expected_class);
    EXPECT_EQ(dGeomIsSpace(as_geom(space)), 1);
    dSpaceDestroy(space);
}

using Levels = std::pair<int, int>;

Levels levels_of(dSpaceID space)
{
    Levels levels;
    dHashSpaceGetLevels(space, &levels.first, &levels.second);
    return levels;
}

// Once, ODE's assertion ended a program whose hash space was replaced in one line.
TEST_F(Contract, 17_LevelsAreKeptAsInAHashSpace)
{
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dSpaceID hash = dHashSpaceCreate(nullptr);
    EXPECT_EQ(levels_of(space), levels_of(hash));
    dHashSpaceSetLevels(space, -7, 4);
    EXPECT_EQ(levels_of(space), Levels(-7, 4));
    dHashSpaceSetLevels(space, 3, 3);
    EXPECT_EQ(levels_of(space), Levels(3, 3));
    dHashSpaceGetLevels(space, nullptr, nullptr);
    if (ode_has_assertions())
    {
        EXPECT_EQ(ode_complaint([=] { dHashSpaceSetLevels(space, 2, -2); }),
                  ode_complaint([=] { dHashSpaceSetLevels(hash, 2, -2); }));
    }
    dSpaceDestroy(hash);
    dSpaceDestroy(space);
}

TEST_F(Contract, 17_LevelsChangeNoPair)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID mover = scene.sphere(1, 0, 0, 0);
        for (int i = 0; i < 30; ++i)
            scene.sphere(0.6, i, 0, 0);
        for (int tick = 0; tick < 100; ++tick)
        {
            if (scene.kind() == SpaceKind::predictive)
                dHashSpaceSetLevels(scene.space(), -tick, tick);
            dGeomSetPosition(mover, 0.3 * tick, 0, 0);
            scene.tick();
        }
    });
}

TEST_F(Contract, 17_TheFunctionsForLevelsRefuseOtherSpaces)
{
    dSpaceID simple = dSimpleSpaceCreate(nullptr);
    if (ode_has_assertions())
    {
        EXPECT_NE(ode_complaint([=] { dHashSpaceSetLevels(simple, -2, 2); }), "");
    }
    dSpaceDestroy(simple);
}

TEST_F(Contract, 17_OnlyPredictiveSpacesArePredictive)
{
    dSpaceID predictive = dPredictiveSpaceCreate(nullptr);
    const dVector3 centre = {0, 0, 0};
    const dVector3 extents = {1, 1, 1};
    dSpaceID others[] = {dSimpleSpaceCreate(predictive), dHashSpaceCreate(nullptr),
                         dQuadTreeSpaceCreate(nullptr, centre, extents, 2),
                         dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)};
    EXPECT_EQ(dSpaceIsPredictive(predictive), 1);
    EXPECT_EQ(dSpaceIsPredictive(nullptr), 0);
    for (dSpaceID other : others)
    {
        EXPECT_EQ(dSpaceIsPredictive(other), 0);
        dSpaceDestroy(other);
    }
    dSpaceDestroy(predictive);
}

TEST_F(Contract, 17_AParentHoldsTheNewSpace)
{
    dSpaceID parent = dHashSpaceCreate(nullptr);
    dSpaceID space = dPredictiveSpaceCreate(parent);
    EXPECT_EQ(dSpaceQuery(parent, as_geom(space)), 1);
    EXPECT_EQ(dSpaceGetNumGeoms(parent), 1);
    dSpaceDestroy(parent);
}

class TinyScene : public OdeTest, public ::testing::WithParamInterface<int>
{};

TEST_P(TinyScene, 18_TinyScenesAreExactFromTheFirstTick)
{
    const int n = GetParam();
    expect_as_simple([=](Scenario &scene) {
        std::mt19937 random(static_cast<unsigned>(n));
        std::uniform_real_distribution<dReal> anywhere(-1, 1);
        scene.numbered(dCreatePlane(scene.space(), 0, 0, 1, 0));
        scene.box(2, 0, 0, 0);
        std::vector<dBodyID> bodies;
        for (int i = 2; i < n; ++i)
        {
            dGeomID geom = scene.sphere(0.2, 2 * anywhere(random), 2 * anywhere(random), anywhere(random));
            bodies.push_back(scene.body(geom, anywhere(random), anywhere(random), anywhere(random)));
        }
        for (int tick = 0; tick < 200; ++tick)
        {
            for (dBodyID body : bodies)
            {
                const dReal *position = dBodyGetPosition(body);
                dBodyAddForce(body, -10 * position[0], -10 * position[1], -10 * position[2]);
            }
            scene.step(0.01);
            scene.tick();
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Contract, TinyScene, ::testing::Values(2, 3, 9, 20, 50, 100));

TEST_F(Contract, 18_NothingMovesNothingIsDone)
{
    Scenario scene(SpaceKind::predictive);
    for (int i = 0; i < 9; ++i)
        scene.sphere(0.6, i, 0, 0);
    scene.tick();
    dPredictiveSpaceStats before;
    dPredictiveSpaceGetStats(scene.space(), &before);
    for (int tick = 0; tick < 100; ++tick)
        scene.tick();
    dPredictiveSpaceStats after;
    dPredictiveSpaceGetStats(scene.space(), &after);
    EXPECT_EQ(after.moved, before.moved);
    EXPECT_EQ(after.repredictions, before.repredictions);
    EXPECT_EQ(after.violations, before.violations);
    EXPECT_EQ(after.reported, before.reported + 100 * 8);
    EXPECT_EQ(scene.log().back().size(), 8u);
    EXPECT_EQ(after.near_pairs, 8u);
    EXPECT_EQ(after.scheduled, 8u);
    dGeomSetPosition(dSpaceGetGeom(scene.space(), 4), 4, 1e-4, 0);
    scene.tick();
    dPredictiveSpaceStats moved;
    dPredictiveSpaceGetStats(scene.space(), &moved);
    EXPECT_EQ(moved.near_pairs, 8u);
    EXPECT_EQ(moved.scheduled, 6u);
    EXPECT_EQ(moved.woken, after.woken + 2);
}
} // namespace
} // namespace ode_predictive_space
