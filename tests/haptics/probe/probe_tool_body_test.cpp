// Probes that hold a tool body, and the encounters that a probe predicts.

#include "ode_predictive_space/haptics/probe.h"

#include "tests/haptics/support/probe_fixture.h"

#include <cmath>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
TEST_F(HapticProbeTest, AToolBodyFollowsTheHandAndIsStoppedByAWall)
{
    ProbeWorld world;
    dWorldSetGravity(world.world, 0, 0, 0);
    dCreatePlane(world.space, 0, 0, 1, 0);
    const dBodyID tool = world.add_moving_box({0.02, 0.02, 0.02}, {0, 0, 0.05}, 0.05);
    ScriptedDevice device(reach({0, 0, 0.05}, {0, 0, 0.006})); // the box would be 4 mm in the wall
    HapticProbe probe(device, tool, CouplingProperties(), RenderSettings());
    world.run(probe, 1000);
    EXPECT_NEAR(dBodyGetPosition(tool)[2], 0.05, 1e-3);
    world.run(probe, 2000);
    EXPECT_NEAR(dBodyGetPosition(tool)[2], 0.01, 1e-3) << "it lies on the wall";
    EXPECT_NEAR(probe.last_tick().force.z(), 500 * 0.004, 0.2);
    EXPECT_EQ(probe.geom(), nullptr);
}

TEST_F(HapticProbeTest, WhatTheHandGetsTheToolLoses)
{
    ProbeWorld world;
    const dBodyID tool = world.add_body({0, 0, 0.05}, 0.5);
    ScriptedDevice device(reach({0, 0, 0.05}, {0.1, 0.02, 0.006}));
    HapticProbe probe(device, tool, CouplingProperties(), RenderSettings());
    dBodyDisable(tool);
    world.run(probe, 100);
    EXPECT_EQ(dBodyIsEnabled(tool), 0) << "it rests where the hand is";
    const Vector3 impulse = impulse_on_hand(world, probe, 1300);
    EXPECT_GT(impulse.norm(), 0.01);
    EXPECT_LE((impulse + momentum_of(tool)).norm(), 1e-9 * impulse.norm());
}

class TurnedDevice : public ScriptedDevice
{
public:
    using ScriptedDevice::ScriptedDevice;
    Quaternion turn = Quaternion::Identity();

protected:
    DeviceState move_to(double seconds) override
    {
        DeviceState state = ScriptedDevice::move_to(seconds);
        state.orientation = turn;
        return state;
    }
};

/// A frame in which z points up turns the handle by 90 degrees; a new body is not turned.
TEST_F(HapticProbeTest, AToolBodyTurnedOtherwiseThanTheHandleIsHeldAsItIs)
{
    for (const bool placed_again : {false, true})
    {
        ProbeWorld world;
        const dBodyID tool = world.add_body(Vector3::Zero(), 0.1);
        TurnedDevice device(reach({0, 0, 0}, {0.04, 0, 0}));
        RenderSettings settings;
        if (!placed_again)
            settings.placement.rotation = WorkspacePlacement::z_up();
        HapticProbe probe(device, tool, CouplingProperties(), settings);
        if (placed_again)
        {
            world.run(probe, 10);
            settings.placement.rotation = WorkspacePlacement::z_up();
            probe.renderer().set_placement(settings.placement);
        }
        double greatest = 0;
        probe.set_recorder([&](const RenderedTick &tick) { greatest = std::max(greatest, tick.force.norm()); });
        world.run(probe, reach_ticks);
        probe.set_recorder({});
        EXPECT_GT(greatest, 0.01);
        EXPECT_NEAR(dBodyGetPosition(tool)[0], 0.04, 2e-3);
        EXPECT_NEAR(tool_state_of(tool).orientation.angularDistance(Quaternion::Identity()), 0, 1e-6);

        const Quaternion quarter(Eigen::AngleAxisd(0.5, Vector3::UnitX()));
        for (int i = 1; i <= 100; ++i)
        {
            device.turn = Quaternion(Eigen::AngleAxisd(0.005 * i, Vector3::UnitX()));
            world.run(probe, 10);
        }
        world.run(probe, 1000);
        const Quaternion &up = settings.placement.rotation;
        const Quaternion turned = up * quarter * up.conjugate();
        EXPECT_NEAR(tool_state_of(tool).orientation.angularDistance(turned), 0, 0.02);
    }
}

/// Explicit springs that are too stiff for a mass diverge, until ODE's assertions end the program.
TEST_F(HapticProbeTest, AToolBodyOfAnyMassFollowsTheHandAndALightOneIsNamed)
{
    for (const double kilograms : {1e-5, 1e-3, 0.2})
    {
        for (const double size : {0.001, 0.05})
        {
            ProbeWorld world;
            dWorldSetGravity(world.world, 0, 0, 0);
            const dBodyID tool = world.add_body(Vector3::Zero(), 1);
            dMass mass;
            dMassSetBoxTotal(&mass, kilograms, size, size / 4, size);
            dBodySetMass(tool, &mass);
            NoticeList notices;
            TurnedDevice device([](double seconds) -> Vector3 { return {0.005 * std::sin(20 * seconds), 0, 0}; });
            RenderSettings settings;
            settings.notice = notices.sink();
            HapticProbe probe(device, tool, CouplingProperties(), settings);
            double farthest = 0;
            for (int i = 0; i < 3000; ++i)
            {
                device.turn = Quaternion(Eigen::AngleAxisd(0.2 * std::sin(0.01 * i), Vector3(0.6, 0.8, 0)));
                world.run(probe, 1);
                if (i > 1000)
                    farthest = std::max(farthest, (tool_state_of(tool).position - probe.tool().position).norm());
            }
            EXPECT_LT(farthest, 0.002) << kilograms << " kg, " << size << " m";
            EXPECT_LT(tool_state_of(tool).angular_velocity.norm(), 5) << kilograms << " kg, " << size << " m";
            EXPECT_EQ(notices.count(NoticeKind::stability), kilograms < 0.1 || size < 0.01 ? 1 : 0)
                << kilograms << " kg, " << size << " m";
        }
    }
}

TEST_F(HapticProbeTest, ADeviceThatTurnsTheHandGetsTheTorqueAndTheToolItsOpposite)
{
    ProbeWorld world;
    const dBodyID tool = world.add_body(Vector3::Zero(), 0.1);
    Capabilities six = desktop_capabilities();
    six.force_axes = 6;
    TurnedDevice device([](double) -> Vector3 { return Vector3::Zero(); }, six);
    RenderSettings settings;
    settings.placement.rotation = WorkspacePlacement::z_up();
    settings.placement.force_scale = 0.5;
    HapticProbe probe(device, tool, CouplingProperties(), settings);
    for (int tick = 0; tick < 1000; ++tick)
    {
        dBodySetTorque(tool, 0, 0, 0);
        probe.begin(dt * tick);
        probe.render(dt);
        device.turn = Quaternion(Eigen::AngleAxisd(0.05, Vector3::UnitY())); // about z in the scene
    }
    EXPECT_NEAR(device.last_wrench().torque.y(), -0.5 * 0.05 * 0.5, 1e-9);
    EXPECT_NEAR(dBodyGetTorque(tool)[2], 0.5 * 0.05, 1e-9);
}

// Its motors cannot turn the handle, but the torque on the tool belongs to the same coupling.
TEST_F(HapticProbeTest, ATorqueOnTheToolComesOnAsGraduallyAsTheForce)
{
    ProbeWorld world;
    const dBodyID tool = world.add_body(Vector3::Zero(), 0.1);
    dBodySetAngularVel(tool, 0, 0, 1);
    ScriptedDevice device([](double) -> Vector3 { return Vector3::Zero(); });
    HapticProbe probe(device, tool, CouplingProperties(), RenderSettings());
    std::vector<double> torques;
    for (int tick = 0; tick < 1000; ++tick)
    {
        probe.begin(dt * tick);
        probe.render(dt);
        torques.push_back(std::abs(dBodyGetTorque(tool)[2]));
        dBodySetTorque(tool, 0, 0, 0);
    }
    EXPECT_GT(torques.back(), 0);
    EXPECT_LT(torques.front(), 0.1 * torques.back());
}

TEST_F(HapticProbeTest, AToolBodyThatIsGoneEndsWithZeroForceAndANotice)
{
    for (const bool with_its_world : {false, true})
    {
        ProbeWorld world;
        const dWorldID own_world = dWorldCreate();
        const dBodyID tool = dBodyCreate(own_world);
        dBodySetKinematic(tool);
        NoticeList notices;
        ScriptedDevice device(reach({0, 0, 0}, {0.004, 0, 0}));
        CouplingProperties stiff;
        stiff.stiffness = 3000;
        HapticProbe probe(device, tool, stiff, with_stiffness(500, notices.sink()));
        world.run(probe, reach_ticks);
        EXPECT_NEAR(device.last_wrench().force.x(), -1000 * 0.004, 1e-6) << "all that the device can render";
        EXPECT_EQ(notices.count(NoticeKind::stability), 1);
        dBodyDestroy(tool);
        if (with_its_world)
            dWorldDestroy(own_world);
        world.run(probe, 10);
        EXPECT_TRUE(device.last_wrench().force.isZero(0));
        EXPECT_EQ(notices.count(NoticeKind::contact), 1) << notices.text(NoticeKind::contact);
        if (!with_its_world)
            dWorldDestroy(own_world);
    }
}

TEST_F(HapticProbeTest, TellsWhatItWillMeetAndWhen)
{
    ProbeWorld world;
    const dGeomID box = world.add_box({0.1, 0.1, 0.1}, {0, 0, -0.05});
    world.add_box({0.1, 0.1, 0.1}, {0, 5, 0});
    constexpr double speed = 0.1; // m/s
    ScriptedDevice device([](double seconds) -> Vector3 { return {0, 0, 0.2 - speed * seconds}; });
    HapticProbe probe(device, world.space, radius);
    world.run(probe, 200);
    probe.encounters();
    world.run(probe, 1600); // up to 1 cm above the box
    const std::vector<Encounter> &encounters = probe.encounters();
    ASSERT_EQ(encounters.size(), 1U);
    EXPECT_EQ(encounters[0].geom, box);
    EXPECT_LE(encounters[0].seconds, 0.01 / speed) << "never late";
}

// Once, at most 64 encounters were listed, so that the next touched object could be missing.
TEST_F(HapticProbeTest, TellsAllThatIsNear)
{
    ProbeWorld world;
    for (int i = 0; i < 100; ++i)
        world.add_box({0.1, 0.1, 0.1}, Vector3::Zero());
    ScriptedDevice device([](double) -> Vector3 { return Vector3::Zero(); });
    HapticProbe probe(device, world.space, radius);
    world.run(probe, 2);
    EXPECT_EQ(probe.encounters().size(), 100U);
}

TEST_F(HapticProbeTest, TellsNothingInAnotherSpace)
{
    ProbeWorld world(SpaceChoice::hash);
    add_shape(world, Shape::box);
    ScriptedDevice device(reach({0, 0, 0.05}, {0, 0, 0.007}));
    HapticProbe probe(device, world.space, radius);
    world.run(probe, 10);
    EXPECT_TRUE(probe.encounters().empty());
}

} // namespace
} // namespace ode_predictive_space::haptics
