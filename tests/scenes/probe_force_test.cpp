#include "demos/runs/spaces.h"
#include "demos/worlds/probe_force.h"

#include <array>
#include <gtest/gtest.h>

namespace ode_predictive_space::worlds
{
namespace
{
class ProbeForceTest : public testing::Test
{
protected:
    ~ProbeForceTest() override { dWorldDestroy(world_); }

    static dContactGeom contact(const Vector3 &point, const Vector3 &normal, double depth)
    {
        dContactGeom result{};
        for (int axis = 0; axis < 3; ++axis)
        {
            result.pos[axis] = point[axis];
            result.normal[axis] = normal[axis];
        }
        result.depth = depth;
        return result;
    }

    OdeSession ode_;
    dWorldID world_ = dWorldCreate();
    dBodyID body_ = dBodyCreate(world_);
    ProbeForce force_;
};

TEST_F(ProbeForceTest, IsStiffnessTimesDepthAlongTheNormal)
{
    const dContactGeom touch = contact({0, 0, 0}, {0, 0, 1}, 0.004);
    force_.touch(&touch, 1, body_);
    EXPECT_TRUE(force_.apply().isApprox(Vector3(0, 0, 2)));
}

TEST_F(ProbeForceTest, ReactionOnTheBodyIsItsOpposite)
{
    const dContactGeom touch = contact({0, 1, 0}, {0, 0, 1}, 0.004);
    force_.touch(&touch, 1, body_);
    const Vector3 force = force_.apply();
    EXPECT_TRUE(from_ode(dBodyGetForce(body_)).isApprox(-force));
    EXPECT_TRUE(from_ode(dBodyGetTorque(body_)).isApprox(Vector3(0, 1, 0).cross(-force)));
}

TEST_F(ProbeForceTest, OneObjectCountsOnceWithItsDeepestContact)
{
    const std::array<dContactGeom, 3> touches = {contact({0, 0, 0}, {1, 0, 0}, 0.001),
                                                 contact({0, 0, 0}, {0, 1, 0}, 0.006),
                                                 contact({0, 0, 0}, {0, 0, 1}, 0.002)};
    force_.touch(touches.data(), 3, body_);
    EXPECT_TRUE(force_.apply().isApprox(Vector3(0, 3, 0)));
}

TEST_F(ProbeForceTest, IsBoundedAndTheReactionWithIt)
{
    const dBodyID second = dBodyCreate(world_);
    const dContactGeom deep = contact({0, 0, 0}, {0, 0, 1}, 1);
    const dContactGeom aside = contact({0, 0, 0}, {1, 0, 0}, 1);
    force_.touch(&deep, 1, body_);
    force_.touch(&aside, 1, second);
    const Vector3 force = force_.apply();
    EXPECT_NEAR(force.norm(), 7.9, 1e-12);
    EXPECT_TRUE((from_ode(dBodyGetForce(body_)) + from_ode(dBodyGetForce(second))).isApprox(-force));
}

TEST_F(ProbeForceTest, ObjectsThatSqueezeTheProbeArePushedNoHarderThanTheMaximum)
{
    const dBodyID second = dBodyCreate(world_);
    const dContactGeom left = contact({0, 0, 0}, {1, 0, 0}, 1);
    const dContactGeom right = contact({0, 0, 0}, {-1, 0, 0}, 1);
    force_.touch(&left, 1, body_);
    force_.touch(&right, 1, second);
    EXPECT_NEAR(force_.apply().norm(), 0, 1e-12);
    EXPECT_NEAR(from_ode(dBodyGetForce(body_)).norm(), 7.9, 1e-12);
    EXPECT_NEAR(from_ode(dBodyGetForce(second)).norm(), 7.9, 1e-12);
}

TEST_F(ProbeForceTest, EachTickBeginsAnew)
{
    const dContactGeom touch = contact({0, 0, 0}, {0, 0, 1}, 0.004);
    force_.touch(&touch, 1, body_);
    force_.apply();
    EXPECT_EQ(force_.apply(), Vector3::Zero());
}

TEST_F(ProbeForceTest, WhatHasNoBodyIsFeltButNotPushed)
{
    const dContactGeom touch = contact({0, 0, 0}, {0, 0, 1}, 0.004);
    force_.touch(&touch, 1, nullptr);
    force_.touch(nullptr, 0, body_);
    EXPECT_TRUE(force_.apply().isApprox(Vector3(0, 0, 2)));
    EXPECT_EQ(from_ode(dBodyGetForce(body_)), Vector3::Zero());
}
} // namespace
} // namespace ode_predictive_space::worlds
