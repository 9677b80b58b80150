#include "ode_predictive_space/haptics/push_response.h"

#include "tests/haptics/probe_world.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double step_length = 0.01; // s
constexpr double kilograms = 0.5;
constexpr double gravity = 9.81;

/// A body at the origin, touched from below z = 0 in the middle: the hand pushes it upwards. What the scene does with it, the test says.
class PushResponseTest : public testing::Test
{
protected:
    PushResponseTest() : body_(world_.add_body(Vector3::Zero(), kilograms))
    {
        touch_.normal = -Vector3::UnitZ();
        touch_.object = reinterpret_cast<std::uintptr_t>(body_);
    }

    double look()
    {
        response_.begin();
        return response_.look(touch_, body_).yield;
    }

    /// @param newtons of the hand on the body. @param gained m/s; by the body, in the step.
    double step(double newtons, double gained)
    {
        response_.note_pushes({{touch_.object, touch_.point, newtons * touch_.normal}});
        touch_.surface_velocity -= gained * touch_.normal;
        return look();
    }

    /// m/s; by a free body.
    static double free_gain(double newtons) { return newtons * step_length / kilograms; }

    const OdeUse ode_;
    ProbeWorld world_;
    const dBodyID body_;
    Touch touch_;
    PushResponse response_{step_length};
};

TEST_F(PushResponseTest, AFreeBodyYieldsAllAndAHeldOneNothing)
{
    look();
    for (const double newtons : {0.5, 1.5, 2.0, 2.1})
    {
        EXPECT_NEAR(step(newtons, free_gain(newtons)), 1, 1e-12);
    }
    touch_.feature = 1; // another touch of it
    look();
    double yield = 1;
    for (const double newtons : {0.5, 1.5, 2.0, 2.1})
    {
        yield = step(newtons, 0);
    }
    EXPECT_NEAR(yield, 0, 0.01);
}

TEST_F(PushResponseTest, ABodyThatPushesAnotherOneOfItsMassYieldsHalf)
{
    look();
    double yield = 1;
    for (const double newtons : {0.5, 1.5, 2.0, 2.1})
    {
        yield = step(newtons, free_gain(newtons) / 2);
    }
    EXPECT_NEAR(yield, 0.5, 0.01);
}

// A hand that carries the body: its weight is always there, and says nothing of what more force would do.
TEST_F(PushResponseTest, WhatActsSteadilyMakesNoDifference)
{
    dWorldSetGravity(world_.world, 0, 0, -gravity);
    look();
    double yield = 1;
    for (int i = 0; i < 100; ++i)
    {
        const double newtons = gravity * kilograms + (i < 20 ? 0.3 * i : 0);
        yield = step(newtons, free_gain(newtons) - gravity * step_length);
        EXPECT_NEAR(yield, 1, 1e-9) << i;
    }
}

TEST_F(PushResponseTest, WhatLiesOnSomethingDoesNotYieldDownwardsBeforeItIsPushed)
{
    dWorldSetGravity(world_.world, 0, 0, -gravity);
    touch_.normal = Vector3::UnitZ();
    look();
    EXPECT_NEAR(look(), 0, 1e-12) << "pushed down";
    touch_.normal = Vector3::UnitX();
    EXPECT_NEAR(look(), 1, 1e-12) << "pushed aside";
    touch_.normal = -Vector3::UnitZ();
    EXPECT_NEAR(look(), 1, 1e-12) << "lifted";
    touch_.normal = Vector3::UnitZ();
    touch_.feature = 1;
    look();
    touch_.surface_velocity.z() -= gravity * step_length;
    EXPECT_NEAR(look(), 1, 1e-12) << "pushed down while it falls";
}

TEST_F(PushResponseTest, TheMobilityIsThatOfOdesBody)
{
    const Vector3 at(0.02, 0.05, -0.01);
    const Vector3 impulse(0.01, -0.02, 0.03); // N s
    dQuaternion turned = {0.8, 0.6, 0, 0};
    dMass mass;
    dMassSetBoxTotal(&mass, kilograms, 0.3, 0.1, 0.2);
    dBodySetMass(body_, &mass);
    dBodySetQuaternion(body_, turned);
    const Vector3 expected = free_mobility_of(body_).response(impulse, at, at);
    dBodySetGyroscopicMode(body_, 0);
    const Vector3 force = impulse / step_length;
    dBodyAddForceAtPos(body_, force.x(), force.y(), force.z(), at.x(), at.y(), at.z());
    const double instant = 1e-9;
    const dReal *total = dBodyGetForce(body_);
    ASSERT_NEAR(total[0], force.x(), 1e-12);
    dBodySetForce(body_, total[0] * step_length / instant, total[1] * step_length / instant,
                  total[2] * step_length / instant);
    const dReal *torque = dBodyGetTorque(body_);
    dBodySetTorque(body_, torque[0] * step_length / instant, torque[1] * step_length / instant,
                   torque[2] * step_length / instant);
    world_.step(instant);
    dVector3 velocity;
    dBodyGetPointVel(body_, at.x(), at.y(), at.z(), velocity);
    EXPECT_LE((expected - Vector3(velocity[0], velocity[1], velocity[2])).norm(), 1e-6 * expected.norm());
}

TEST_F(PushResponseTest, NothingMovesAKinematicBodyOrAGeomWithoutABody)
{
    dBodySetKinematic(body_);
    EXPECT_EQ(response_.look(touch_, body_).inverse_mass, 0);
    EXPECT_EQ(response_.look(touch_, nullptr).inverse_mass, 0);
}
} // namespace
} // namespace ode_predictive_space::haptics
