#include "ode_predictive_space/haptics/probe.h"

#include "tests/haptics/support/probe_fixture.h"

#include <cmath>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
TEST_F(HapticProbeTest, ForceIsStiffnessTimesDepthAlongTheNormalInAnySpace)
{
    for (const SpaceChoice choice : all_space_choices)
    {
        for (const Shape shape : {Shape::plane, Shape::sphere, Shape::box})
        {
            for (const double depth : {0.0001, 0.004})
            {
                ProbeWorld world(choice);
                add_shape(world, shape);
                ScriptedDevice device(reach({0, 0, 0.05}, {0, 0, radius - depth}));
                HapticProbe probe(device, world.space, radius, with_stiffness(800));
                world.run(probe, reach_ticks);
                const Vector3 expected = 800 * depth * Vector3::UnitZ();
                EXPECT_LE((probe.last_tick().force - expected).norm(), 1e-9 * expected.norm())
                    << static_cast<int>(choice) << ' ' << static_cast<int>(shape) << ' ' << depth;
                EXPECT_LE((device.last_wrench().force - expected).norm(), 1e-9 * expected.norm());
            }
        }
    }
}

TEST_F(HapticProbeTest, WhatTheHandGetsTheBodyLosesWhileTheForceIsClampedAndSlewed)
{
    ProbeWorld world;
    const dBodyID body = world.add_moving_box({0.1, 0.1, 0.1}, {0, 0, -0.05}, 100);
    NoticeList notices;
    ScriptedDevice device([](double seconds) -> Vector3 {
        return {0, 0, seconds < 1 ? 0.03 : 0.03 - 0.06 * std::pow(std::sin(32 * (seconds - 1)), 2)};
    });
    HapticProbe probe(device, world.space, radius, with_stiffness(1000, notices.sink()));
    const Vector3 impulse = impulse_on_hand(world, probe, 1400);
    EXPECT_EQ(notices.count(NoticeKind::safety), 1) << notices.text(NoticeKind::safety);
    EXPECT_LE((impulse + momentum_of(body)).norm(), 1e-9 * impulse.norm());
}

TEST_F(HapticProbeTest, SeveralBodiesShareWhatTheHandGets)
{
    ProbeWorld world;
    const dBodyID left = world.add_moving_box({0.1, 0.1, 0.1}, {-0.0549, 0, 0}, 50);
    const dBodyID right = world.add_moving_box({0.1, 0.1, 0.1}, {0.0549, 0, 0}, 70);
    ScriptedDevice device(reach({0, 0, 0.09}, {0.001, 0, 0.04}));
    HapticProbe probe(device, world.space, radius, with_stiffness(1000));
    const Vector3 impulse = impulse_on_hand(world, probe, 3000);
    EXPECT_GT(momentum_of(left).norm(), 0.1);
    EXPECT_GT(momentum_of(right).norm(), 0.1);
    EXPECT_LE((impulse + momentum_of(left) + momentum_of(right)).norm(), 1e-9 * momentum_of(left).norm());
}

TEST_F(HapticProbeTest, BodiesMayBeDestroyedAtAnyTime)
{
    ProbeWorld world;
    const dBodyID first = world.add_moving_box({0.1, 0.1, 0.1}, {0, 0, -0.05}, 1000);
    const dBodyID second = world.add_moving_box({0.1, 0.1, 0.1}, {0, 0, -0.055}, 1000);
    for (const dBodyID body : {first, second})
    {
        dGeomSetCategoryBits(dBodyGetFirstGeom(body), 2); // they do not push each other
        dGeomSetCollideBits(dBodyGetFirstGeom(body), ~2UL);
    }
    ScriptedDevice device(reach({0, 0, 0.05}, {0, 0, 0.002}));
    HapticProbe probe(device, world.space, radius, with_stiffness(400));
    world.run(probe, reach_ticks);
    ASSERT_EQ(probe.touches().size(), 2U);

    const dGeomID geom = dBodyGetFirstGeom(first);
    dGeomDestroy(geom);
    dBodyDestroy(first);
    world.run(probe, 100);
    ASSERT_EQ(probe.touches().size(), 1U);

    // The body is destroyed between the collision and the reaction.
    probe.begin(2);
    world.collide(probe);
    dGeomDestroy(dBodyGetFirstGeom(second));
    dBodyDestroy(second);
    probe.render(dt);
    world.step(dt);
    world.run(probe, 10);
    EXPECT_TRUE(probe.touches().empty());
    EXPECT_EQ(dSpaceGetNumGeoms(world.space), 1);
}

TEST_F(HapticProbeTest, TheProgramMayGiveAGeomAndKeepsIt)
{
    ProbeWorld world;
    add_shape(world, Shape::plane);
    const dGeomID capsule = dCreateCapsule(world.space, 0.01, 0.04);
    ScriptedDevice device(reach({0, 0, 0.08}, {0, 0, 0.028}));
    {
        HapticProbe probe(device, capsule, with_stiffness(800));
        EXPECT_EQ(dPredictiveSpaceGetGeomRole(world.space, capsule), dPredictiveRoleInteractive);
        world.run(probe, reach_ticks);
        EXPECT_NEAR(probe.last_tick().force.z(), 1.6, 1e-9);
    }
    EXPECT_EQ(dSpaceQuery(world.space, capsule), 1);
    EXPECT_EQ(dGeomGetBody(capsule), nullptr) << "it is left as it was";
    const dGeomID in_no_space = dCreateSphere(nullptr, radius);
    EXPECT_EQ(HapticProbe(device, in_no_space).geom(), in_no_space);
    dGeomDestroy(in_no_space);
}

TEST_F(HapticProbeTest, WhatCannotBeAProbeIsRefused)
{
    ProbeWorld world;
    ScriptedDevice device(reach(Vector3::Zero(), Vector3::Zero()));
    const dBodyID body = world.add_moving_box({0.1, 0.1, 0.1}, Vector3::Zero(), 1);
    EXPECT_THROW(HapticProbe(device, world.space, 0.0), std::invalid_argument);
    EXPECT_THROW(HapticProbe(device, dCreatePlane(world.space, 0, 0, 1, 0)), std::invalid_argument);
    EXPECT_THROW(HapticProbe(device, dBodyGetFirstGeom(body)), std::invalid_argument);
    EXPECT_FALSE(device.status().open) << "what was opened in vain is closed again";
}

TEST_F(HapticProbeTest, AProbeThatRestsDoesNotBotherTheSpace)
{
    ProbeWorld world;
    add_shape(world, Shape::plane);
    ScriptedDevice device([](double) -> Vector3 { return {0, 0, 0.1}; });
    HapticProbe probe(device, world.space, radius);
    EXPECT_EQ(dPredictiveSpaceGetGeomRole(world.space, probe.geom()), dPredictiveRoleInteractive);
    world.run(probe, 100);
    dPredictiveSpaceStats before, after;
    dPredictiveSpaceGetStats(world.space, &before);
    world.run(probe, 100);
    dPredictiveSpaceGetStats(world.space, &after);
    EXPECT_EQ(after.moved, before.moved);
}

TEST_F(HapticProbeTest, AWorkspaceInAnotherFrameIsFeltTheSame)
{
    ProbeWorld world;
    add_shape(world, Shape::plane);
    RenderSettings settings = with_stiffness(400);
    settings.placement.rotation = WorkspacePlacement::z_up();
    settings.placement.scale = 2;
    settings.placement.force_scale = 0.5;
    ScriptedDevice device(reach({0, 0.04, 0}, {0, 0.004, 0})); // y is up for the hand: 8 mm in the scene
    HapticProbe probe(device, world.space, radius, std::move(settings));
    world.run(probe, reach_ticks);
    EXPECT_NEAR(probe.last_tick().force.z(), 0.8, 1e-9);
    EXPECT_NEAR(device.last_wrench().force.y(), 0.4, 1e-9);
}

TEST_F(HapticProbeTest, ALawThatIsSetBetweenTwoTicksGetsTheTouchesInItsOwnView)
{
    ProbeWorld world;
    for (int i = 0; i < 2; ++i)
        add_shape(world, Shape::box);
    ScriptedDevice device(reach({0, 0, 0.05}, {0, 0, radius - 0.002}));
    HapticProbe probe(device, world.space, radius, with_stiffness(300));
    world.run(probe, reach_ticks);
    EXPECT_NEAR(probe.last_tick().requested.z(), 2 * 300 * 0.002, 1e-9) << "each box pushes";
    probe.renderer().set_law(make_law(true, {300}));
    world.run(probe, 100);
    EXPECT_NEAR(probe.last_tick().requested.z(), 300 * 0.002, 1e-6) << "both hold one proxy";
}

TEST_F(HapticProbeTest, AToolThatJumpsThroughAPlateIsNotHeldByIt)
{
    ProbeWorld world;
    world.add_box({0.4, 0.4, 0.001}, {0, 0, 0});
    ScriptedDevice device([](double seconds) -> Vector3 { return {0, 0, seconds < 0.0995 ? 0.02 : -0.03}; });
    HapticProbe probe(device, world.space, radius);
    world.run(probe, 100);
    const int jumps = probe.last_tick().tool_jumps;
    world.run(probe, 1);
    EXPECT_EQ(probe.last_tick().tool_jumps, jumps + 1);
    EXPECT_TRUE(probe.touches().empty());
}

TEST_F(HapticProbeTest, ADeviceThatCannotPushStillPushesBodies)
{
    Capabilities pointer = desktop_capabilities();
    pointer.force_axes = 0;
    pointer.max_force = 0;
    ProbeWorld world;
    const dBodyID body = world.add_moving_box({0.1, 0.1, 0.1}, {0, 0, -0.05}, 1);
    ScriptedDevice device(reach({0, 0, 0.05}, {0, 0, -0.02}), pointer);
    HapticProbe probe(device, world.space, radius);
    world.run(probe, reach_ticks);
    EXPECT_LT(momentum_of(body).z(), -0.01);
    EXPECT_TRUE(device.last_wrench().force.isZero(0));
}
} // namespace
} // namespace ode_predictive_space::haptics
