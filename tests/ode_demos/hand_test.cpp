#include "demos/ode/hand.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

namespace ode_predictive_space::ode_demos
{
namespace
{
class HandTest : public testing::Test
{
protected:
    HandTest()
    {
        dInitODE2(0);
        world_ = dWorldCreate();
        place_.space = dSimpleSpaceCreate(nullptr);
        place_.bounds = {Vector3(-1, -1, 0), Vector3(1, 1, 1)};
        hand_ = std::make_unique<Hand>("hand-path");
        hand_->step(place_);
        probe_ = dSpaceGetGeom(place_.space, 0);
    }

    ~HandTest() override
    {
        hand_.reset();
        dSpaceDestroy(place_.space);
        dWorldDestroy(world_);
        dCloseODE();
    }

    static void near(void *test, dGeomID first, dGeomID second)
    {
        auto &self = *static_cast<HandTest *>(test);
        self.taken_ += self.hand_->touch(first, second) ? 1 : 0;
    }

    /// For half a second a ball is right below the probe, slightly inside it. Before that the hand is free, as the safety stage
    /// requires.
    void follow_with(dBodyID ball, dReal radius)
    {
        hand_->step(place_);
        for (int frame = 0; frame < 30; ++frame)
        {
            const dReal *at = dGeomGetPosition(probe_);
            dBodySetPosition(ball, at[0], at[1], at[2] - radius);
            dBodySetForce(ball, 0, 0, 0);
            taken_ = 0;
            dSpaceCollide(place_.space, this, &near);
            hand_->step(place_);
        }
    }

    dBodyID add_ball(dSpaceID space, dReal radius)
    {
        const dBodyID body = dBodyCreate(world_);
        dGeomSetBody(dCreateSphere(space, radius), body);
        dBodySetPosition(body, 100, 0, 0);
        return body;
    }

    dWorldID world_;
    Place place_;
    std::unique_ptr<Hand> hand_;
    dGeomID probe_;
    int taken_ = 0; ///< pairs that the hand has handled
};

TEST_F(HandTest, PushesABody)
{
    const dBodyID ball = add_ball(place_.space, 0.5);
    follow_with(ball, 0.5);
    EXPECT_EQ(taken_, 1);
    EXPECT_LT(dBodyGetForce(ball)[2], 0);
    EXPECT_GT(hand_->largest_force(), 0);
    EXPECT_GT(hand_->frames_with_force(), 0);
}

TEST_F(HandTest, PushesABodyInANestedSpace)
{
    const dBodyID ball = add_ball(dSimpleSpaceCreate(place_.space), 0.5);
    follow_with(ball, 0.5);
    EXPECT_EQ(taken_, 1);
    EXPECT_LT(dBodyGetForce(ball)[2], 0);
}

TEST_F(HandTest, LeavesRaysToTheDemo)
{
    const dReal *at = dGeomGetPosition(probe_);
    const dGeomID ray = dCreateRay(place_.space, 10);
    dGeomRaySet(ray, at[0], at[1], at[2] - 5, 0, 0, 1);
    dSpaceCollide(place_.space, this, &near);
    EXPECT_EQ(taken_, 0);
}

TEST_F(HandTest, ReachesAllOfThePlaceAndNotFarBelow)
{
    Eigen::AlignedBox3d reached;
    for (int frame = 0; frame < 6000; ++frame)
    {
        hand_->step(place_);
        const dReal *at = dGeomGetPosition(probe_);
        reached.extend(Vector3(at[0], at[1], at[2]));
    }
    EXPECT_LT(reached.min().z(), 0.1);
    EXPECT_GT(reached.min().z(), -1);
    EXPECT_GT(reached.max().z(), 0.9);
    EXPECT_LT(reached.min().x(), -0.9);
    EXPECT_GT(reached.max().y(), 0.9);
}

TEST_F(HandTest, GoesToAnotherSpace)
{
    hand_->leave();
    EXPECT_EQ(dSpaceGetNumGeoms(place_.space), 0);
    hand_->step(place_);
    EXPECT_EQ(dSpaceGetNumGeoms(place_.space), 1);
}
} // namespace
} // namespace ode_predictive_space::ode_demos
