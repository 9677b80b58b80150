// Faults of a probe's device or contacts end with zero force and a notice.

#include "tests/haptics/support/faulty_device.h"
#include "tests/haptics/support/probe_fixture.h"

#include <gtest/gtest.h>
#include <limits>
#include <optional>

namespace ode_predictive_space::haptics
{
namespace
{
class ProbeFaultTest : public HapticProbeTest
{
protected:
    static constexpr double depth = 0.004; // m

    ProbeFaultTest() : scripted_(reach({0, 0, 0.05}, {0, 0, radius - depth})), device_(scripted_)
    {
        add_shape(world_, Shape::plane);
    }

    void press(HapticProbe &probe)
    {
        world_.run(probe, reach_ticks);
        ASSERT_NEAR(device_.last_wrench().force.z(), 800 * depth, 1e-9);
    }

    void expect_to_wait_after(Breakage breakage)
    {
        HapticProbe probe(device_, world_.space, radius, with_stiffness(800, notices_.sink()));
        press(probe);
        device_.break_now(breakage);
        world_.run(probe, 200);
        device_.break_now(Breakage::none);
        world_.run(probe, 110);
        EXPECT_TRUE(device_.last_wrench().force.isZero(0)) << "the probe is deep in the plane: the stage waits";
    }

    ProbeWorld world_;
    NoticeList notices_;
    ScriptedDevice scripted_;
    FaultyDevice device_;
};

TEST_F(ProbeFaultTest, ABodyGetsNothingFromADeviceThatIsLost)
{
    for (const Breakage breakage : {Breakage::lost, Breakage::unwritable})
    {
        ProbeWorld world;
        const dBodyID body = world.add_moving_box({0.1, 0.1, 0.1}, {0, 0, -0.05}, 1000);
        device_.break_now(Breakage::none);
        HapticProbe probe(device_, world.space, radius, with_stiffness(800));
        world.run(probe, reach_ticks);
        device_.break_now(breakage);
        const Vector3 before = momentum_of(body);
        EXPECT_LT(before.z(), 0);
        world.run(probe, 100);
        EXPECT_FALSE(probe.last_tick().device_answers);
        EXPECT_EQ(momentum_of(body), before);
    }
}

TEST_F(ProbeFaultTest, ADeviceThatFailsIsTriedAgainTenTimesASecond)
{
    HapticProbe probe(device_, world_.space, radius, with_stiffness(800));
    world_.run(probe, 10);
    int tries = 0;
    scripted_.before_read = [&] {
        ++tries;
        throw DeviceError(DeviceFault::failed, "the device does not answer");
    };
    world_.run(probe, 1000);
    EXPECT_NEAR(tries, 10, 1);
}

TEST_F(ProbeFaultTest, TheForceComesBackSlowlyWhenTheDeviceDoes)
{
    expect_to_wait_after(Breakage::unreadable);
    EXPECT_EQ(notices_.count(NoticeKind::device), 2) << "it says that it is back";
}

TEST_F(ProbeFaultTest, AfterLongNonsenseOfTheDeviceTheStageWaitsToo)
{
    expect_to_wait_after(Breakage::not_a_number);
}

TEST_F(ProbeFaultTest, AVelocityThatIsNotANumberEndsWithZeroForceAndANotice)
{
    ProbeWorld world;
    const dBodyID body = world.add_moving_box({0.1, 0.1, 0.1}, {0, 0, -0.05}, 1000);
    HapticProbe probe(device_, world.space, radius, with_stiffness(800, notices_.sink()));
    world.run(probe, reach_ticks);
    ASSERT_GT(device_.last_wrench().force.z(), 1);
    dBodySetLinearVel(body, std::numeric_limits<dReal>::quiet_NaN(), 0, 0);
    probe.begin(reach_ticks * dt);
    world.collide(probe);
    probe.render(dt);
    EXPECT_TRUE(device_.last_wrench().force.isZero(0));
    EXPECT_EQ(notices_.count(NoticeKind::contact), 1);
}

TEST_F(ProbeFaultTest, AtTheEndThereIsNoForceAndWhatWasOpenStaysOpen)
{
    scripted_.open();
    {
        HapticProbe probe(device_, world_.space, radius, with_stiffness(800));
        press(probe);
    }
    EXPECT_TRUE(device_.last_wrench().force.isZero(0));
    EXPECT_TRUE(scripted_.status().open);
    scripted_.close();
    {
        const HapticProbe probe(device_, world_.space, radius);
        EXPECT_TRUE(scripted_.status().open);
    }
    EXPECT_FALSE(scripted_.status().open);
}

void expect_no_force_without_a_geom(HapticProbe &probe, const ScriptedDevice &device)
{
    EXPECT_EQ(probe.geom(), nullptr);
    for (int tick = 0; tick < 10; ++tick)
    {
        probe.begin(dt * tick);
        EXPECT_TRUE(probe.encounters().empty());
        probe.render(dt);
    }
    EXPECT_TRUE(device.last_wrench().force.isZero(0));
}

// Once, ODE crashed without a message.
TEST_F(ProbeFaultTest, ASpaceThatIsDestroyedFirstIsTold)
{
    for (const SpaceChoice choice : all_space_choices)
    {
        for (const bool own_geom : {false, true})
        {
            NoticeList notices;
            ScriptedDevice device(reach({0, 0, 0.05}, {0, 0, radius - depth}));
            const dSpaceID space = make_space(choice);
            dCreatePlane(space, 0, 0, 1, 0);
            {
                const RenderSettings settings = with_stiffness(800, notices.sink());
                std::optional<HapticProbe> probe;
                if (own_geom)
                    probe.emplace(device, dCreateCapsule(space, radius, 0.01), settings);
                else
                    probe.emplace(device, space, radius, settings);
                EXPECT_NE(probe->geom(), nullptr);
                dSpaceDestroy(space);
                expect_no_force_without_a_geom(*probe, device);
            }
            EXPECT_EQ(notices.count(NoticeKind::contact), 1) << own_geom;
        }
    }
}

TEST_F(ProbeFaultTest, ASpaceThatIsDestroyedJustBeforeItsProbeIsToldOfAtTheEnd)
{
    NoticeList notices;
    ScriptedDevice device(reach({0, 0, 0.05}, {0, 0, radius - depth}));
    const dSpaceID space = make_space(SpaceChoice::hash);
    {
        HapticProbe probe(device, space, radius, with_stiffness(800, notices.sink()));
        dSpaceDestroy(space);
    }
    EXPECT_EQ(notices.count(NoticeKind::contact), 1);
}
} // namespace
} // namespace ode_predictive_space::haptics
