#include "ode_predictive_space/haptics/drivers.h"

#include "tests/haptics/stand_ins/fake_spacenavd.h"
#include "tests/support/error_of.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace ode_predictive_space::haptics;
using ode_predictive_space::error_of;

namespace
{
constexpr int full = 350;

/// Full deflection is 0.1 m/s and 2 rad/s, and every deflection counts.
constexpr SpacenavSettings without_dead_zone{0.1, 2, 0, 0.05};

class Spacenav : public testing::Test
{
protected:
    FakeSpacenavd server;
    SpacenavDevice device{without_dead_zone};
};

DeviceState read_until(SpacenavDevice &device, double from, double to)
{
    DeviceState state;
    for (int i = 0; i <= std::lround((to - from) * 1000); ++i)
        state = device.read(from + 0.001 * i);
    return state;
}
} // namespace

TEST_F(Spacenav, TellsWhatItIsAndThatItCannotPush)
{
    device.open();
    EXPECT_EQ(device.capabilities().name, "Stand-in Mouse");
    EXPECT_EQ(device.capabilities().input_axes, 6);
    EXPECT_EQ(device.capabilities().force_axes, 0);
    EXPECT_EQ(device.capabilities().max_force, 0);
    EXPECT_EQ(device.capabilities().workspace.max(), Vector3::Constant(0.05));
    EXPECT_NO_THROW(device.write({Vector3(1, 1, 1), Vector3::Zero()}));
    EXPECT_TRUE(device.status().open && device.status().ready);
}

TEST(SpacenavSettings, MustBeInTheirRanges)
{
    EXPECT_THROW(SpacenavDevice({0, 1, 0, 0.1}), std::invalid_argument);
    EXPECT_THROW(SpacenavDevice({0.1, -1, 0, 0.1}), std::invalid_argument);
    EXPECT_THROW(SpacenavDevice({0.1, 1, 1, 0.1}), std::invalid_argument);
    EXPECT_THROW(SpacenavDevice({0.1, 1, std::nan(""), 0.1}), std::invalid_argument);
    EXPECT_THROW(SpacenavDevice({0.1, 1, 0, HUGE_VAL}), std::invalid_argument);
    EXPECT_NO_THROW(SpacenavDevice({0.1, 1, 0, 0.1}));
}

TEST_F(Spacenav, IntegratesTheDeflectionToAPosition)
{
    device.open();
    device.read(1);
    server.send_motion(full, full / 2, full / 4, 0, 0, 0);
    // The server's z points away from the person.
    const Vector3 velocity = 0.1 * Vector3(1, 0.5, -87 / 350.0);
    DeviceState state = read_until(device, 1.001, 1.1);
    EXPECT_DOUBLE_EQ(state.time, 1.1);
    EXPECT_TRUE(state.linear_velocity.isApprox(velocity, 1e-12)) << state.linear_velocity;
    EXPECT_TRUE(state.position.isApprox(0.1 * velocity, 1e-9)) << state.position;

    server.send_motion(0, 0, 0, 0, 0, 0);
    state = read_until(device, 1.101, 1.2);
    EXPECT_TRUE(state.position.isApprox(0.1 * velocity, 1e-9)) << "it stays where it was let go";
    EXPECT_EQ(state.linear_velocity, Vector3::Zero());
}

TEST_F(Spacenav, IntegratesTheTwistToAnOrientation)
{
    device.open();
    device.read(0);
    server.send_motion(0, 0, 0, full, 0, 0);
    DeviceState state = read_until(device, 0.001, 0.5);
    EXPECT_TRUE(state.angular_velocity.isApprox(Vector3(2, 0, 0)));
    const Quaternion about_x(Eigen::AngleAxisd(1, Vector3::UnitX()));
    EXPECT_LT(state.orientation.angularDistance(about_x), 1e-9);

    // The axes are fixed: the first turn does not turn the axis of the second.
    server.send_motion(0, 0, 0, 0, 0, -full);
    state = read_until(device, 0.501, 1);
    const Quaternion about_z(Eigen::AngleAxisd(1, Vector3::UnitZ()));
    EXPECT_LT(state.orientation.angularDistance(about_z * about_x), 1e-9);
    EXPECT_EQ(state.position, Vector3::Zero());
}

TEST_F(Spacenav, StopsAtTheWallsOfItsWorkspace)
{
    device.open();
    device.read(0);
    server.send_motion(full, -full / 10, full, 0, 0, 0);
    const DeviceState state = read_until(device, 0.001, 2);
    EXPECT_EQ(state.position.x(), 0.05);
    EXPECT_EQ(state.linear_velocity.x(), 0);
    EXPECT_EQ(state.position.z(), -0.05);
    EXPECT_EQ(state.linear_velocity.z(), 0);
    EXPECT_LT(state.linear_velocity.y(), 0) << "along the wall it goes on";

    server.send_motion(-full, 0, 0, 0, 0, 0);
    EXPECT_LT(read_until(device, 2.001, 2.1).position.x(), 0.05) << "and away from it at once";
}

TEST_F(Spacenav, CountsALongPauseBetweenReadsAsAShortOne)
{
    device.open();
    device.read(0);
    server.send_motion(full, 0, 0, 0, 0, 0);
    EXPECT_NEAR(device.read(10).position.x(), 0.1 * SpacenavDevice::longest_step, 1e-12);
}

TEST_F(Spacenav, NeedsMoreThanTheDeadZone)
{
    SpacenavDevice with_dead_zone({0.1, 1, 0.1, 0.1});
    with_dead_zone.open();
    server.send_motion(full / 10, -full / 10, 0, full / 10, 0, 0);
    DeviceState state = with_dead_zone.read(0);
    EXPECT_EQ(state.linear_velocity, Vector3::Zero());
    EXPECT_EQ(state.angular_velocity, Vector3::Zero());

    // Beyond the dead zone the speed starts at zero. Full deflection still is full speed, and more is clamped.
    server.send_motion(full / 10 + 1, -full, 2 * full, 0, 0, 0);
    state = with_dead_zone.read(0.001);
    EXPECT_NEAR(state.linear_velocity.x(), 0.1 * (1 / 350.0) / 0.9, 1e-12);
    EXPECT_NEAR(state.linear_velocity.y(), -0.1, 1e-12);
    EXPECT_NEAR(state.linear_velocity.z(), -0.1, 1e-12);
}

TEST_F(Spacenav, TellsItsButtons)
{
    device.open();
    server.send_button(0, true);
    server.send_button(3, true);
    EXPECT_EQ(device.read(0).buttons, 9u);
    server.send_button(0, false);
    server.send_button(32, true);
    EXPECT_EQ(device.read(0.001).buttons, 8u);
}

TEST_F(Spacenav, OverlooksWhatItDoesNotUnderstand)
{
    device.open();
    server.send_nonsense();
    server.send_plugged_in();
    server.send_button(1, true);
    EXPECT_EQ(device.read(0).buttons, 2u);
}

TEST_F(Spacenav, NeverWaitsForTheRestOfAnEvent)
{
    device.open();
    server.send_half_a_motion(full);
    EXPECT_NO_THROW(device.read(0));
}

TEST_F(Spacenav, IsLostWhenTheServerEnds)
{
    device.open();
    server.send_motion(full, 0, 0, 0, 0, 0);
    device.read(0);
    server.stop();
    for (int i = 0; i < 2; ++i)
    {
        const DeviceError error = error_of<DeviceError>([&] { device.read(0.001); });
        EXPECT_EQ(error.fault(), DeviceFault::lost);
        EXPECT_PRED_FORMAT2(testing::IsSubstring, "spacenavd has ended", error.what());
    }
    EXPECT_THROW(device.write({}), DeviceError);
    EXPECT_TRUE(device.status().open);
    EXPECT_FALSE(device.status().ready);
    EXPECT_PRED_FORMAT2(testing::IsSubstring, "spacenavd has ended", device.status().explanation);
}

TEST_F(Spacenav, IsLostWhenTheMouseIsUnplugged)
{
    device.open();
    server.send_unplugged();
    EXPECT_THROW(device.read(0), DeviceError);
    EXPECT_FALSE(device.status().ready);
}

TEST_F(Spacenav, StartsAnewAfterItWasClosed)
{
    device.open();
    device.read(0);
    server.send_motion(full, 0, 0, 0, 0, 0);
    read_until(device, 0, 0.1);
    device.close();
    EXPECT_THROW(device.read(0.2), DeviceError);
    EXPECT_THROW(device.write({}), DeviceError);
    EXPECT_FALSE(device.status().open);

    device.open();
    device.open();
    EXPECT_EQ(read_until(device, 0.2, 0.3).position, Vector3::Zero());
}
