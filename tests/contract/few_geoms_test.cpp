// A space of few geoms compares all pairs until it has to predict. Its reports stay the same through the change.

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
constexpr int few = 16;

struct FewGeoms : OdeTest
{
    ~FewGeoms() override
    {
        dSpaceDestroy(space);
        dWorldDestroy(world);
    }

    dGeomID add()
    {
        const dGeomID geom = number_geom(dCreateSphere(space, 1), static_cast<int>(geoms.size()));
        dGeomSetBody(geom, dBodyCreate(world));
        dGeomSetPosition(geom, 1.5 * static_cast<double>(geoms.size()), 0, 0);
        geoms.push_back(geom);
        return geom;
    }
    void fill()
    {
        for (int i = 0; i < few; ++i)
            add();
    }

    void move()
    {
        for (const dGeomID geom : geoms)
            dGeomSetPosition(geom, dGeomGetPosition(geom)[0] + 0.01, 0, 0);
    }

    void expect_row()
    {
        Pairs expected;
        for (int i = 0; i + 1 < static_cast<int>(geoms.size()); ++i)
            expected.push_back({i, i + 1});
        EXPECT_EQ(unordered(collide(space)), expected);
    }

    // A space that predicts counts new envelopes.
    bool predicts()
    {
        move();
        expect_row();
        dPredictiveSpaceStats stats;
        dPredictiveSpaceGetStats(space, &stats);
        return stats.repredictions > 0;
    }

    dWorldID world = dWorldCreate();
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    std::vector<dGeomID> geoms;
};

TEST_F(FewGeoms, AreNotPredicted)
{
    fill();
    for (int tick = 0; tick < 100; ++tick)
        ASSERT_FALSE(predicts()) << "tick " << tick;
    dPredictiveSpaceStats stats;
    dPredictiveSpaceGetStats(space, &stats);
    EXPECT_EQ(stats.ticks, 100u);
    EXPECT_EQ(stats.reported, 100u * (few - 1));
    EXPECT_EQ(stats.moved, 0u);
}

TEST_F(FewGeoms, ArePredictedFromTheNextOneOnWhateverLeaves)
{
    fill();
    EXPECT_FALSE(predicts());
    add();
    EXPECT_TRUE(predicts());
    dGeomDestroy(geoms.back());
    geoms.pop_back();
    EXPECT_TRUE(predicts());
    EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
}

TEST_F(FewGeoms, ArePredictedWhenSomebodyAsksAboutTheFuture)
{
    fill();
    expect_row();
    dReal ticks = -1;
    EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(space, geoms[0], geoms[1], &ticks), 1);
    EXPECT_EQ(ticks, 0);
    EXPECT_TRUE(predicts());
}

TEST_F(FewGeoms, ArePredictedWhenTheSpaceIsValidated)
{
    fill();
    expect_row();
    EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
    EXPECT_TRUE(predicts());
}

TEST_F(FewGeoms, AreNotPredictedByShapeUntilAContactIsDearToFind)
{
    fill();
    dPredictiveSpacePrepare(space);
    dPredictiveSpaceSetProximity(space, dPredictiveProximityShape);
    dPredictiveSpacePrepare(space);
    EXPECT_FALSE(predicts());
    const dGeomID probe = number_geom(dCreateSphere(nullptr, 0.1), -2);
    dGeomSetPosition(probe, dGeomGetPosition(geoms[3])[0], 0, 0);
    EXPECT_EQ(collide2(as_geom(space), probe).size(), 1u);
    dGeomDestroy(probe);
    EXPECT_FALSE(predicts()) << "by a query";
    dGeomDestroy(geoms.back());
    geoms.pop_back();
    const float heights[4] = {0, 0, 0, 0};
    const dHeightfieldDataID field = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildSingle(field, heights, 0, 4, 4, 2, 2, 1, 0, 1, 0);
    const dGeomID ground = number_geom(dCreateHeightfield(space, field, 1), few);
    dGeomSetPosition(ground, 0, 100, 0);
    EXPECT_TRUE(predicts());
    dGeomDestroy(ground);
    dGeomHeightfieldDataDestroy(field);
}

TEST_F(FewGeoms, ArePredictedBySphereAlsoAfterwards)
{
    fill();
    expect_row();
    dPredictiveSpaceSetProximity(space, dPredictiveProximityBox);
    EXPECT_FALSE(predicts());
    dPredictiveSpaceSetProximity(space, dPredictiveProximitySphere);
    EXPECT_TRUE(predicts());
    dPredictiveSpaceSetProximity(space, dPredictiveProximityBox);
    expect_row();
}

TEST_F(FewGeoms, ArePredictedByTheirRolesAndKeepTheSettingsMadeBefore)
{
    fill();
    dPredictiveSpaceSetHorizon(space, 3, 7);
    EXPECT_EQ(dPredictiveSpaceGetGeomRole(space, geoms[0]), dPredictiveRoleEnvironment);
    EXPECT_FALSE(predicts());
    dPredictiveSpaceSetGeomRole(space, geoms[0], dPredictiveRoleInteractive);
    EXPECT_EQ(dPredictiveSpaceGetGeomRole(space, geoms[0]), dPredictiveRoleInteractive);
    EXPECT_TRUE(predicts());
    int least = 0, most = 0;
    dPredictiveSpaceGetHorizon(space, &least, &most);
    EXPECT_EQ(least, 3);
    EXPECT_EQ(most, 7);
}

TEST_F(FewGeoms, AreFoundByQueriesWithoutBeingPredicted)
{
    fill();
    const dGeomID probe = number_geom(dCreateSphere(nullptr, 0.1), -2);
    for (int tick = 0; tick < 40; ++tick)
    {
        move();
        dGeomSetPosition(probe, dGeomGetPosition(geoms[3])[0], 0, 0);
        ASSERT_EQ(collide2(as_geom(space), probe).size(), 1u);
    }
    dGeomDestroy(probe);
    EXPECT_FALSE(predicts());
}

void ask_for_encounters(void *data, dGeomID first, dGeomID)
{
    ++*static_cast<int *>(data);
    dPredictiveSpaceGetEncounters(dGeomGetSpace(first), first, nullptr, 0);
}

TEST_F(FewGeoms, MayBeginToBePredictedWithinTheirCallbacks)
{
    fill();
    int calls = 0;
    dSpaceCollide(space, &calls, ask_for_encounters);
    EXPECT_EQ(calls, few - 1);
    EXPECT_TRUE(predicts());
}

TEST_F(FewGeoms, AreToldThatTheirDataHaveChanged)
{
    fill();
    expect_row();
    dReal points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    dReal planes[] = {0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, 0, 1, 1, 1, 1};
    const unsigned polygons[] = {3, 0, 2, 1, 3, 0, 1, 3, 3, 0, 3, 2, 3, 1, 2, 3};
    const dGeomID convex = number_geom(dCreateConvex(nullptr, planes, 4, points, 4, polygons), few);
    dGeomSetPosition(convex, -0.9, 2, 0); // near the first sphere only
    dGeomDestroy(geoms.back());
    geoms.pop_back();
    dSpaceAdd(space, convex);
    expect_row();
    points[7] = -3; // reaches the first sphere
    dPredictiveSpaceGeomChanged(space, convex);
    EXPECT_EQ(collide(space).size(), geoms.size());
    dGeomDestroy(convex);
}
} // namespace
} // namespace ode_predictive_space
