// The worlds in which objects touch: pile, stack, terrain, mix.

#include "tests/scenes/motion.h"

#include <gtest/gtest.h>
#include <set>

namespace ode_predictive_space::worlds
{
namespace
{
TEST(MixWorld, LeavesTheProbeToWhoBringsOne)
{
    const OdeSession ode;
    WorldSpec spec{"mix", 40, 1};
    WorldRun with(SpaceKind::simple, WorldFactory(spec));
    spec.own_probe = false;
    WorldRun without(SpaceKind::simple, WorldFactory(spec));
    EXPECT_EQ(dSpaceGetNumGeoms(without.contender().space()) + 1, dSpaceGetNumGeoms(with.contender().space()));
    for (int tick = 0; tick < 200; ++tick)
        without.tick();
    EXPECT_NE(with.scene().probe(), nullptr);
    EXPECT_EQ(without.scene().probe(), nullptr);
    EXPECT_GT(without.contacts(), 0u) << "walls and objects still touch";
}

TEST(Pile, HasSettled)
{
    const OdeSession ode;
    WorldRun pile(SpaceKind::simple, WorldFactory({"pile", 60, 1}));
    for (int tick = 0; tick < 100; ++tick)
        pile.tick();
    EXPECT_GT(pile.contacts(), 100u * 60u) << "each object touches others";
    Motion motion({"pile", 60, 1});
    motion.advance();
    EXPECT_LT(motion.longest_way(), 0.1 * object_radius);
}

// The haptic loop of two threads tells by them that a program steps by dWorldQuickStep().
TEST(Pile, DrawsNumbersThatEverybodySees)
{
    const OdeSession ode;
    WorldRun pile(SpaceKind::simple, WorldFactory({"pile", 60, 1}));
    pile.tick();
    const unsigned long seed = dRandGetSeed();
    pile.tick();
    EXPECT_NE(dRandGetSeed(), seed);
}

/// Bodies of the space's geoms that are not disabled.
int awake_bodies(dSpaceID space)
{
    int awake = 0;
    for (int i = 0; i < dSpaceGetNumGeoms(space); ++i)
    {
        const dBodyID body = dGeomGetBody(dSpaceGetGeom(space, i));
        awake += body != nullptr && dBodyIsEnabled(body) != 0 ? 1 : 0;
    }
    return awake;
}

TEST(Stack, SleepsUntilTheBallHitsAndThenAPartOfItSleepsOn)
{
    const OdeSession ode;
    const WorldFactory factory({"stack", 192, 1});
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    const std::unique_ptr<World> scene = factory.make(space.get());
    PairList pairs;
    int before_throw = 0;
    int most_after = 0;
    for (int tick = 0; tick < 3 * 400; ++tick)
    {
        scene->advance();
        pairs.clear();
        dSpaceCollide(space.get(), &pairs, &PairList::collect);
        scene->respond(pairs.sorted());
        const int awake = awake_bodies(space.get());
        before_throw = tick == 89 ? awake : before_throw;
        most_after = tick > 490 ? std::max(most_after, awake) : most_after;
    }
    EXPECT_LE(before_throw, 10) << "walls and towers are at rest";
    EXPECT_GE(most_after, 10) << "later throws hit something, too";
    EXPECT_LE(most_after, 150);
}

TEST(Terrain, AllObjectsMoveAtNoMoreThanFiveMillimetresPerTickAndMostBoxesDoNot)
{
    Motion motion({"terrain", 100, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 100 + 2) << "the airships move; the cranes turn in place";
    EXPECT_LE(motion.longest_way(), 0.0055);
    EXPECT_GT(motion.longest_way(), 0.003);
}

TEST(Terrain, WhatRollsTouchesTheGround)
{
    Motion motion({"terrain", 100, 1});
    for (int tick = 0; tick < 500; ++tick)
        motion.advance();
    PairList pairs;
    dSpaceCollide(motion.space(), &pairs, &PairList::collect);
    std::set<std::uint32_t> on_ground;
    for (const auto &[first, second] : pairs.sorted())
        on_ground.insert(first < 3 ? second : 0);
    EXPECT_GE(on_ground.size(), 50u) << "half of the objects roll; the ground has the numbers 0 to 2";
}

TEST(Terrain, ItsLargestBoxIsTenThousandTimesAsLongAsAnObject)
{
    Motion motion({"terrain", 100, 1});
    double largest = 0;
    double smallest = dInfinity;
    for (int i = 0; i < dSpaceGetNumGeoms(motion.space()); ++i)
    {
        const dGeomID geom = dSpaceGetGeom(motion.space(), i);
        if (dGeomGetClass(geom) == dBoxClass)
        {
            dVector3 sides;
            dGeomBoxGetLengths(geom, sides);
            largest = std::max(largest, sides[0]);
            smallest = std::min(smallest, sides[0]);
        }
    }
    EXPECT_GE(largest, 1e4 * smallest);
}

TEST(Mix, ObjectsKeepFloatingAndTheProbeTouchesSome)
{
    const OdeSession ode;
    WorldRun mix(SpaceKind::simple, WorldFactory({"mix", 60, 1}));
    for (int tick = 0; tick < 3000; ++tick)
        mix.tick();
    const ProbeLog &log = mix.probe_log();
    EXPECT_FALSE(log.touched.empty());
    EXPECT_GT(log.max_force, 0);
    EXPECT_LE(log.max_force, 7.9 * (1 + 1e-12));
    EXPECT_LT(log.ticks_in_touch, 3000u);

    Motion motion({"mix", 60, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 30 + 1) << "half of the objects, and the probe";
}
} // namespace
} // namespace ode_predictive_space::worlds
