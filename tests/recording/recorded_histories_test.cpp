// Random histories, recorded by their outermost space and replayed: the replay must have the pairs that the space reported.

#include <algorithm>

#include <gtest/gtest.h>

#include <ode_predictive_space/history.h>

#include "tests/contract/support/ode_test.h"
#include "tests/contract/support/scenario.h"
#include "tests/differential/generator.h"
#include "tests/differential/universe.h"
#include "tests/recording/recorded.h"

namespace ode_predictive_space::recording
{
namespace
{

void apply(const Operation &operation, Universe &universe)
{
    switch (operation.action)
    {
    case Action::tick:
    case Action::tick_asking:
        universe.tick();
        return;
    case Action::calm:
        for (int i = 0; i < operation.number; ++i)
        {
            for (int step = 0; step < operation.object; ++step)
                universe.step(operation.value[0]);
            universe.tick();
        }
        return;
    case Action::query:
        universe.query(operation.subject, operation.object);
        return;
    default:
        universe.apply(operation);
    }
}

// Replaces results of a user class's AABBTest, and infinite boxes of nested sap and quadtree spaces, which are not recorded.
Operation recordable(Operation operation)
{
    if (operation.action == Action::make_geom && operation.number == static_cast<int>(GeomKind::user))
        operation.number = static_cast<int>(GeomKind::box);
    const auto kind = static_cast<NestedKind>(operation.number % 16);
    if (operation.action == Action::make_space && (kind == NestedKind::sweep_and_prune || kind == NestedKind::quadtree))
        operation.number += static_cast<int>(NestedKind::hash) - static_cast<int>(kind);
    return operation;
}

Recording recorded(const ode_predictive_space::History &history)
{
    const ScratchFile file;
    {
        Universe universe(ode_predictive_space::SpaceKind::predictive, history);
        EXPECT_EQ(dPredictiveSpaceRecord(universe.outermost(), file.path().c_str(), 0), 1);
        for (const Operation &operation : history.operations)
            apply(recordable(operation), universe);
    }
    return Recording::read(file.path());
}

class RecordedHistories : public OdeTest, public testing::WithParamInterface<Flavour>
{};

TEST_P(RecordedHistories, AreReplayedWithThePairsThatTheSpaceReported)
{
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
    {
        const Recording recording = recorded(make_history({GetParam(), 20, 150, true}, seed));
        EXPECT_TRUE(recording.has_end());
        // ODE's other spaces miss pairs of geoms that are far larger than their neighbours.
        expect_pairs_agree(recording, {SpaceKind::simple, SpaceKind::box, SpaceKind::sphere, SpaceKind::shape});
        ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
}

using RecordedHistory = OdeTest;

// ODE drops the offset with the body.
TEST_F(RecordedHistory, OfAGeomThatGoesToAnotherBodyAtTheSameOffset)
{
    const dWorldID world = dWorldCreate();
    const dSpaceID space = dHashSpaceCreate(nullptr);
    const dBodyID bodies[] = {dBodyCreate(world), dBodyCreate(world)};
    dBodySetPosition(bodies[1], 10, 0, 0);
    const dGeomID ball = dCreateSphere(space, 1), core = dCreateSphere(space, 1);
    dGeomSetPosition(dCreateSphere(space, 1), 13, 0, 0);
    dGeomSetBody(core, bodies[1]);
    Recorded recorded;
    const int expected[] = {0, 1};
    for (int i = 0; i < 2; ++i)
    {
        dGeomSetBody(ball, bodies[i]);
        dGeomSetOffsetPosition(ball, 3, 0, 0);
        EXPECT_EQ(recorded.collide(space), expected[i]);
    }
    dGeomSphereSetRadius(core, REAL(0.9)); // its box follows from the body's pose again
    EXPECT_EQ(recorded.collide(space), 1);
    expect_pairs_agree(recorded.end());
    dSpaceDestroy(space);
    dWorldDestroy(world);
}

TEST_F(RecordedHistory, OfASpaceDeepInANest)
{
    const ScratchFile file;
    const dSpaceID outermost = dPredictiveSpaceCreate(nullptr), outer = dPredictiveSpaceCreate(outermost),
                   inner = dPredictiveSpaceCreate(outer);
    dCreateSphere(inner, 1);
    dCreateSphere(inner, 1);
    ASSERT_EQ(dPredictiveSpaceRecord(inner, file.path().c_str(), 0), 1);
    EXPECT_EQ(collide(inner).size(), 1u);
    EXPECT_EQ(dPredictiveSpaceRecord(inner, nullptr, 0), 1);
    expect_pairs_agree(Recording::read(file.path()));
    dSpaceDestroy(outermost);
}

INSTANTIATE_TEST_SUITE_P(Each, RecordedHistories,
                         testing::Values(Flavour::calm, Flavour::mixed, Flavour::wild, Flavour::teleport, Flavour::pile,
                                         Flavour::nests, Flavour::explosion),
                         [](const auto &info) { return flavour_name(info.param); });
} // namespace
} // namespace ode_predictive_space::recording
