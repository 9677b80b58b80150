// The worlds whose objects follow a motion of their own: that which they promise, and no other.

#include "tests/scenes/motion.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::worlds
{
namespace
{
TEST(Gas, HalfMovesAtNoMoreThanAHundredthOfTheRadiusPerTick)
{
    Motion motion({"gas", 100, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 50);
    EXPECT_LE(motion.longest_way(), 0.01 * object_radius * 1.0001);
    EXPECT_GT(motion.longest_way(), 0.005 * object_radius);
}

TEST(Gas, TheShareThatMovesCanBeChosen)
{
    Motion motion({"gas", 100, 1, 0.1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 10);
}

TEST(Gas, WhatMovesHasABodyAndTheVelocityOfItsMotion)
{
    Motion motion({"gas", 100, 1});
    motion.advance();
    int bodies = 0;
    for (int i = 0; i < dSpaceGetNumGeoms(motion.space()); ++i)
    {
        const dGeomID geom = dSpaceGetGeom(motion.space(), i);
        const Vector3 way = motion.after().at(geom_index(geom)) - motion.before().at(geom_index(geom));
        if (const dBodyID body = dGeomGetBody(geom))
        {
            ++bodies;
            EXPECT_LT((0.001 * from_ode(dBodyGetLinearVel(body)) - way).norm(), 1e-12);
        }
        else
        {
            EXPECT_EQ(way.norm(), 0);
        }
    }
    EXPECT_EQ(bodies, 50);
}

TEST(Gas, BouncesOffTheWalls)
{
    Motion motion({"gas", 100, 1});
    const double half = WorldFactory({"gas", 100, 1}).bounds().half_extent.x();
    for (int tick = 0; tick < 5000; ++tick)
        motion.advance();
    for (const auto &[index, place] : motion.after())
        EXPECT_LT(place.cwiseAbs().maxCoeff(), half) << "geom " << index;
    EXPECT_EQ(motion.moved(), 50);
}

TEST(Game, AllMoveAtNoMoreThanATenthOfTheRadiusPerTick)
{
    for (const char *name : {"game", "classes"})
    {
        Motion motion({name, 100, 1});
        motion.advance();
        EXPECT_EQ(motion.moved(), 100);
        EXPECT_LE(motion.longest_way(), 0.1 * object_radius * 1.0001);
        EXPECT_GT(motion.longest_way(), 0.05 * object_radius);
    }
}

TEST(Still, NothingMoves)
{
    Motion motion({"still", 100, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 0);
}

TEST(Churn, OneInAHundredIsReplacedInEachTick)
{
    Motion motion({"churn", 200, 1});
    for (int tick = 0; tick < 20; ++tick)
    {
        motion.advance();
        EXPECT_EQ(motion.after().size(), 200u);
        EXPECT_GE(motion.made(), 1);
        EXPECT_LE(motion.made(), 2);
    }
    EXPECT_EQ(motion.after().rbegin()->first, 200u + 20 * 2 - 1) << "numbers are not given twice";
}

TEST(Churn, ASmallSceneSavesUpFractions)
{
    Motion motion({"churn", 20, 1});
    int made = 0;
    for (int tick = 0; tick < 52; ++tick)
    {
        motion.advance();
        made += motion.made();
    }
    EXPECT_EQ(made, 10);
}

TEST(Explosion, AllVelocitiesChangeInOneTickOutOfTwoHundred)
{
    Motion motion({"explosion", 60, 1});
    std::map<std::uint32_t, Vector3> last_way;
    int ticks_of_change = 0;
    for (int tick = 1; tick <= 450; ++tick)
    {
        motion.advance();
        int changed = 0;
        for (const auto &[index, place] : motion.after())
        {
            const Vector3 way = place - motion.before().at(index);
            changed += tick > 1 && (way - last_way[index]).norm() > 1e-12 ? 1 : 0;
            last_way[index] = way;
        }
        if (changed > 50)
        {
            ++ticks_of_change;
            EXPECT_EQ(tick % 200, 0);
        }
    }
    EXPECT_EQ(ticks_of_change, 2);
}

TEST(Teleport, EverythingJumps)
{
    Motion motion({"teleport", 100, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 100);
    EXPECT_GT(motion.longest_way(), 5 * object_radius);
}
} // namespace
} // namespace ode_predictive_space::worlds
