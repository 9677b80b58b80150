#include "ode_predictive_space/haptics/loop/island_roll_out.h"

#include "tests/haptics/coupling_scene.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
Vector3 place_of(dBodyID body)
{
    const dReal *place = dBodyGetPosition(body);
    return {place[0], place[1], place[2]};
}

Vector3 velocity_of(dBodyID body)
{
    const dReal *velocity = dBodyGetLinearVel(body);
    return {velocity[0], velocity[1], velocity[2]};
}

class IslandRollOutTest : public testing::Test
{
protected:
    IslandRollOutTest()
    {
        rope(3, 0.002).build(scene_);
        other_ = scene_.add_ball(1, 0.01, {1, 0, 0});
    }

    const OdeUse ode_;
    CouplingScene scene_{Stepper::exact};
    dBodyID other_;
};

TEST_F(IslandRollOutTest, FindsWhatTheWorldDoes)
{
    const dBodyID ball = scene_.bodies[1];
    const Vector3 impulse(1e-4, 0, 0);
    std::vector<Vector3> foreseen;
    {
        IslandRollOut island({ball});
        island.run(false, 3, 0.01, {{ball, place_of(ball), impulse}},
                   [&](std::size_t) { foreseen.push_back(place_of(ball)); });
    }
    const Vector3 at = place_of(ball);
    dBodyAddForceAtPos(ball, impulse.x() / 0.01, 0, 0, at.x(), at.y(), at.z());
    for (const Vector3 &place : foreseen)
    {
        scene_.step(0.01);
        EXPECT_LE((place_of(ball) - place).norm(), 1e-12);
    }
    EXPECT_GT((place_of(ball) - at).norm(), 1e-4);
}

TEST_F(IslandRollOutTest, PutsAllBack)
{
    const dBodyID ball = scene_.bodies[0];
    dBodyAddForce(ball, 0.1, 0.2, 0.3);
    dBodySetLinearVel(ball, 0.1, 0, 0);
    dJointFeedback feedback = {};
    dJointSetFeedback(dBodyGetJoint(ball, 0), &feedback);
    dRandSetSeed(5);
    {
        IslandRollOut island({ball});
        island.run(true, 4, 0.01, {}, [](std::size_t) {});
        EXPECT_TRUE(island.has_joints());
    }
    EXPECT_TRUE(place_of(ball).isZero(0));
    EXPECT_EQ(velocity_of(ball), Vector3(0.1, 0, 0));
    EXPECT_DOUBLE_EQ(dBodyGetForce(ball)[2], 0.3);
    EXPECT_EQ(dJointGetFeedback(dBodyGetJoint(ball, 0)), &feedback);
    EXPECT_EQ(feedback.f1[2], 0) << "it is the program's, for its own steps";
    EXPECT_EQ(dRandGetSeed(), 5U);
}

TEST_F(IslandRollOutTest, OtherBodiesDoNotMove)
{
    {
        IslandRollOut island({scene_.bodies[0]});
        island.run(false, 4, 0.01, {}, [&](std::size_t) { EXPECT_EQ(place_of(other_), Vector3(1, 0, 0)); });
    }
    EXPECT_TRUE(velocity_of(other_).isZero(0));
    EXPECT_NE(dBodyIsEnabled(other_), 0);
}

// Without a geom and a joint. It was moved by each trial, and not put back.
TEST_F(IslandRollOutTest, BodiesThatNothingLeadsToDoNotMove)
{
    const dBodyID lost = dBodyCreate(dBodyGetWorld(other_));
    dBodySetLinearVel(lost, 1, 2, 3);
    {
        IslandRollOut island({scene_.bodies[0]});
        island.run(false, 4, 0.01, {}, [&](std::size_t) { EXPECT_TRUE(place_of(lost).isZero(0)); });
    }
    EXPECT_EQ(velocity_of(lost), Vector3(1, 2, 3));
    EXPECT_NE(dBodyIsEnabled(lost), 0);
    dBodyDestroy(lost);
}

TEST_F(IslandRollOutTest, WhatSleepsGoesOnSleeping)
{
    dBodyDisable(scene_.bodies[0]);
    dBodyDisable(other_);
    {
        IslandRollOut island({scene_.bodies[1]});
        island.run(false, 4, 0.01, {}, [](std::size_t) {});
    }
    EXPECT_EQ(dBodyIsEnabled(scene_.bodies[0]), 0);
    EXPECT_EQ(dBodyIsEnabled(other_), 0);
    EXPECT_NE(dBodyIsEnabled(scene_.bodies[1]), 0);
}

// A ball that hangs between two joints: (T1 + T2) r / I, with the weights below it.
TEST_F(IslandRollOutTest, TheFastestSwingOfARopeIsThatOfItsUppermostBall)
{
    IslandRollOut island({scene_.bodies[2]});
    const double moment = 0.4 * 0.002 * 0.009 * 0.009;
    EXPECT_NEAR(island.fastest_swing(false, 0.001), std::sqrt(5 * 0.002 * CouplingScene::gravity * 0.01 / moment), 0.5);
}
} // namespace
} // namespace ode_predictive_space::haptics
