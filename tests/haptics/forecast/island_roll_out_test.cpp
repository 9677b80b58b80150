#include "ode_predictive_space/haptics/loop/island_roll_out.h"

#include "tests/haptics/forecast/coupling_scene.h"

#include <algorithm>
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
        IslandRollOut island({ball}, false);
        island.run(3, 0.01, {{ball, Vector3::Zero(), impulse}},
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

TEST_F(IslandRollOutTest, ABodyThatDoesNotTakePartIsNotPushed)
{
    const Vector3 at = place_of(other_);
    {
        IslandRollOut island({scene_.bodies[1]}, false);
        island.run(3, 0.01, {{other_, at, {1, 0, 0}}}, [](std::size_t) {});
    }
    EXPECT_EQ((place_of(other_) - at).norm(), 0);
    EXPECT_EQ(velocity_of(other_).norm(), 0);
    EXPECT_NE(dBodyIsEnabled(other_), 0);
}

TEST_F(IslandRollOutTest, PutsAllBack)
{
    const dBodyID ball = scene_.bodies[0];
    dBodyAddForce(ball, 0.1, 0.2, 0.3);
    dBodyAddTorque(ball, 0.4, 0.5, 0.6);
    dBodySetLinearVel(ball, 0.1, 0, 0);
    dBodySetAngularVel(ball, 0.7, 0, 0);
    dJointFeedback feedback = {};
    dJointSetFeedback(dBodyGetJoint(ball, 0), &feedback);
    dRandSetSeed(5);
    {
        IslandRollOut island({ball}, true);
        island.run(4, 0.01, {}, [](std::size_t) {});
        EXPECT_TRUE(island.has_joints());
    }
    EXPECT_TRUE(place_of(ball).isZero(0));
    EXPECT_EQ(velocity_of(ball), Vector3(0.1, 0, 0));
    EXPECT_EQ(dBodyGetQuaternion(ball)[0], 1);
    EXPECT_EQ(dBodyGetAngularVel(ball)[0], 0.7);
    EXPECT_DOUBLE_EQ(dBodyGetForce(ball)[2], 0.3);
    EXPECT_DOUBLE_EQ(dBodyGetTorque(ball)[2], 0.6);
    EXPECT_EQ(dJointGetFeedback(dBodyGetJoint(ball, 0)), &feedback);
    EXPECT_EQ(feedback.f1[2], 0) << "it is the program's, for its own steps";
    EXPECT_EQ(dRandGetSeed(), 5U);
}

// The body has no geom and no joint. Once, each trial moved it, and it was not put back.
TEST_F(IslandRollOutTest, BodiesThatNothingLeadsToDoNotMove)
{
    const dBodyID lost = dBodyCreate(dBodyGetWorld(other_));
    dBodySetLinearVel(lost, 1, 2, 3);
    {
        IslandRollOut island({scene_.bodies[0]}, false);
        island.run(4, 0.01, {}, [&](std::size_t) { EXPECT_TRUE(place_of(lost).isZero(0)); });
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
        IslandRollOut island({scene_.bodies[1]}, false);
        island.run(4, 0.01, {}, [](std::size_t) {});
    }
    EXPECT_EQ(dBodyIsEnabled(scene_.bodies[0]), 0);
    EXPECT_EQ(dBodyIsEnabled(other_), 0);
    EXPECT_NE(dBodyIsEnabled(scene_.bodies[1]), 0);
}

// ODE counts the steps for which a body has been idle. Trials must neither add to the count nor reset it.
TEST_F(IslandRollOutTest, AnIdleBodyFallsAsleepWhenItWouldHave)
{
    constexpr int idle_steps = 10;
    const dJointID peg = dJointCreateBall(dBodyGetWorld(other_), nullptr);
    dJointAttach(peg, other_, nullptr);
    dJointSetBallAnchor(peg, 1, 0, 0);
    dBodySetAutoDisableFlag(other_, 1);
    dBodySetAutoDisableSteps(other_, idle_steps);
    dBodySetAutoDisableTime(other_, 0);
    dBodyEnable(other_);
    for (int step = 1; step <= idle_steps; ++step)
    {
        {
            IslandRollOut island({scene_.bodies[0]}, false);
            for (int trial = 0; trial < 8; ++trial)
                island.run(4, 0.01, {}, [](std::size_t) {});
        }
        EXPECT_NE(dBodyIsEnabled(other_), 0) << step;
        EXPECT_EQ(dBodyGetAutoDisableSteps(other_), idle_steps);
        scene_.step(0.01);
    }
    EXPECT_EQ(dBodyIsEnabled(other_), 0);
}

// A row of joined balls that is longer than the part that is tried out.
class LongRow : public testing::TestWithParam<bool>
{
protected:
    LongRow() { rope(200, 0.002).build(scene_); }

    int most() const { return GetParam() ? IslandRollOut::most_ends_by_quick_step : IslandRollOut::most_ends; }

    const OdeUse ode_;
    CouplingScene scene_{Stepper::exact};
};

TEST_P(LongRow, IsPutBack)
{
    const std::size_t middle = scene_.bodies.size() / 2;
    std::vector<Vector3> before;
    for (const dBodyID body : scene_.bodies)
        before.push_back(place_of(body));
    {
        IslandRollOut island({scene_.bodies[middle]}, GetParam());
        island.run(4, 0.001, {{scene_.bodies[middle], place_of(scene_.bodies[middle]), {1e-4, 0, 0}}},
                   [](std::size_t) {});
    }
    for (std::size_t i = 0; i < before.size(); ++i)
    {
        const dBodyID body = scene_.bodies[i];
        EXPECT_EQ(place_of(body), before[i]) << i;
        EXPECT_TRUE(velocity_of(body).isZero(0)) << i;
        EXPECT_EQ(dBodyIsKinematic(body), 0) << i;
        EXPECT_NE(dBodyIsEnabled(body), 0) << i;
        for (int n = 0; n < dBodyGetNumJoints(body); ++n)
            EXPECT_NE(dJointIsEnabled(dBodyGetJoint(body, n)), 0) << i;
    }
}

// Also a joint of a body at the border. A body that the program has made kinematic stays that, too.
TEST_P(LongRow, WhatTheProgramHasDisabledStaysSo)
{
    const std::size_t middle = scene_.bodies.size() / 2;
    for (const dBodyID body : scene_.bodies)
    {
        const dJointID joint = dBodyGetJoint(body, 0);
        dJointDisable(joint);
        dBodySetKinematic(body);
        IslandRollOut({scene_.bodies[middle]}, GetParam()); // puts all back at once
        EXPECT_EQ(dJointIsEnabled(joint), 0);
        EXPECT_NE(dBodyIsKinematic(body), 0);
        dJointEnable(joint);
        dBodySetDynamic(body);
    }
}

// Bodies beyond that part are held in place, and hold the others.
TEST_P(LongRow, AnswersAPushAsTheWholeRowDoes)
{
    const std::size_t middle = scene_.bodies.size() / 2;
    const dBodyID ball = scene_.bodies[middle];
    const Vector3 impulse(1e-4, 0, 0), at = place_of(ball);
    Vector3 foreseen;
    {
        IslandRollOut island({ball}, GetParam());
        island.run(1, 0.001, {{ball, Vector3::Zero(), impulse}}, [&](std::size_t) { foreseen = place_of(ball) - at; });
    }
    dBodyAddForceAtPos(ball, impulse.x() / 0.001, 0, 0, at.x(), at.y(), at.z());
    GetParam() ? dWorldQuickStep(dBodyGetWorld(ball), 0.001) : dWorldStep(dBodyGetWorld(ball), 0.001);
    const Vector3 moved = place_of(ball) - at;
    EXPECT_LE((foreseen - moved).norm(), (GetParam() ? 0.2 : 0.01) * moved.norm());
}

INSTANTIATE_TEST_SUITE_P(Steppers, LongRow, testing::Bool(),
                         [](const auto &info) { return info.param ? "quick" : "exact"; });

// The squared frequency of a ball that hangs between two joints is (T1 + T2) r / I; both tensions are the weights below.
TEST_F(IslandRollOutTest, TheFastestSwingOfARopeIsThatOfItsUppermostBall)
{
    IslandRollOut island({scene_.bodies[2]}, false);
    const double moment = 0.4 * 0.002 * 0.009 * 0.009;
    EXPECT_NEAR(island.fastest_swing(0.001), std::sqrt(5 * 0.002 * CouplingScene::gravity * 0.01 / moment), 0.5);
}

TEST_F(IslandRollOutTest, ABallSwingsOnAHingeAndOnAUniversalJointToo)
{
    const dJointID hinge = dJointCreateHinge(scene_.world, nullptr);
    const dJointID universal = dJointCreateUniversal(scene_.world, nullptr);
    for (const dJointID joint : {hinge, universal})
    {
        const dBodyID ball = scene_.add_ball(0.002, 0.009, {0, 1, 0});
        dJointAttach(joint, ball, nullptr);
        joint == hinge ? dJointSetHingeAnchor(joint, 0, 1, 0.01) : dJointSetUniversalAnchor(joint, 0, 1, 0.01);
        IslandRollOut island({ball}, false);
        const double moment = 0.4 * 0.002 * 0.009 * 0.009;
        EXPECT_NEAR(island.fastest_swing(0.001), std::sqrt(0.002 * CouplingScene::gravity * 0.01 / moment), 0.5);
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
