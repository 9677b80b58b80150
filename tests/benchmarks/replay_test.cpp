#include "tests/benchmarks/replay.h"

#include "demos/runs/world_run.h"
#include "demos/worlds/world.h"

#include <gtest/gtest.h>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

std::vector<std::vector<IndexPair>> pairs_of_replay(const WorldFactory &factory, dSpaceID space, const Motion &motion)
{
    Replay replay(factory, space);
    std::vector<std::vector<IndexPair>> pairs;
    for (const std::vector<Move> &moves : motion)
    {
        replay.make(moves);
        PairList list;
        dSpaceCollide(space, &list, &PairList::collect);
        pairs.push_back(list.sorted());
    }
    return pairs;
}

TEST(Replay, MovesAsTheSceneDid)
{
    const OdeSession ode;
    for (const char *name : {"gas", "mix", "pile", "teleport", "explosion"})
    {
        const WorldFactory factory({name, 40, 2});
        Recorder recorder(factory);
        Motion motion = recorder.record(150);
        const Motion rest = recorder.record(100);
        motion.insert(motion.end(), rest.begin(), rest.end());
        const OwnedSpace space(make_space(SpaceKind::quadtree, factory));
        const auto replayed = pairs_of_replay(factory, space.get(), motion);

        WorldRun original(SpaceKind::simple, factory);
        original.turn(250);
        for (std::size_t tick = 0; tick < replayed.size(); ++tick)
        {
            ASSERT_EQ(hash_pairs(replayed[tick]), original.tick_hashes()[tick]) << name << ", tick " << tick;
        }
    }
}

TEST(Replay, WhatRestsIsNotMoved)
{
    const OdeSession ode;
    Recorder recorder(WorldFactory({"gas", 40, 1}));
    for (const std::vector<Move> &moves : recorder.record(5))
    {
        EXPECT_EQ(moves.size(), 20u);
    }
    Recorder still(WorldFactory({"still", 40, 1}));
    EXPECT_TRUE(still.record(1).front().empty());
}

TEST(Replay, BodiesOfSeveralGeomsAndSpacesInTheSpaceMoveAsTheyDid)
{
    const OdeSession ode;
    for (const char *name : {"nested", "ragdolls"})
    {
        const WorldFactory factory({name, 3, 2});
        const Motion motion = Recorder(factory).record(100);
        const OwnedSpace space(make_space(SpaceKind::hash, factory));
        Replay replay(factory, space.get());
        WorldRun original(SpaceKind::simple, factory);
        original.turn(100);
        for (std::size_t tick = 0; tick < motion.size(); ++tick)
        {
            replay.make(motion[tick]);
            PairList list;
            replay.scene().collide(space.get(), &list, PairList::near);
            ASSERT_EQ(hash_pairs(list.sorted()), original.tick_hashes()[tick]) << name << ", tick " << tick;
        }
    }
}

TEST(Replay, ScenesWhoseGeomsComeAndGoAreRefused)
{
    const OdeSession ode;
    EXPECT_THROW(Recorder(WorldFactory({"churn", 200, 1})).record(20), std::logic_error);
}

TEST(Replay, AChangeOfVelocityIsPassedOn)
{
    const OdeSession ode;
    const WorldFactory factory({"explosion", 5, 1});
    const Motion motion = Recorder(factory).record(200);
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    Replay replay(factory, space.get());
    replay.make(motion[198]);
    const dBodyID body = dGeomGetBody(dSpaceGetGeom(space.get(), 0));
    const Vector3 before = from_ode(dBodyGetLinearVel(body));
    replay.make(motion[199]);
    EXPECT_GT((from_ode(dBodyGetLinearVel(body)) - before).norm(), 1e-6);
}
} // namespace
} // namespace ode_predictive_space::benchmarks
