#include "tests/haptics/faulty_device.h"

#include "ode_predictive_space/haptics/hand_path.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
const Wrench one_newton = {Vector3(1, 0, 0), Vector3::Zero()};

class FaultyDeviceTest : public testing::Test
{
protected:
    FaultyDeviceTest()
    {
        faulty_.open();
        faulty_.read(0);
    }

    HandPathDevice device_;
    FaultyDevice faulty_{device_};
};

TEST_F(FaultyDeviceTest, IsWholeUntilItBreaksAndAfterItHasBeenMended)
{
    faulty_.break_at(1, Breakage::lost, 2);
    EXPECT_NO_THROW(faulty_.read(0.999));
    faulty_.write(one_newton);
    EXPECT_EQ(device_.last_wrench().force, one_newton.force);
    EXPECT_TRUE(faulty_.status().ready);
    EXPECT_THROW(faulty_.read(1), DeviceError);
    EXPECT_THROW(faulty_.write(one_newton), DeviceError);
    EXPECT_FALSE(faulty_.status().ready);
    EXPECT_TRUE(faulty_.read(2).position.allFinite());
    EXPECT_EQ(faulty_.writes(), 1);
    faulty_.close();
    EXPECT_FALSE(device_.status().open);
}

TEST_F(FaultyDeviceTest, CanBeReadOnlyOrWrittenOnly)
{
    faulty_.break_now(Breakage::unreadable);
    EXPECT_THROW(faulty_.read(1), DeviceError);
    EXPECT_NO_THROW(faulty_.write(one_newton));
    faulty_.break_now(Breakage::unwritable);
    EXPECT_NO_THROW(faulty_.read(2));
    EXPECT_THROW(faulty_.write(one_newton), DeviceError);
    EXPECT_EQ(faulty_.writes(), 1);
}

TEST_F(FaultyDeviceTest, TellsNonsense)
{
    faulty_.break_now(Breakage::not_a_number);
    EXPECT_TRUE(faulty_.read(1).position.hasNaN());
    faulty_.break_now(Breakage::endless_velocity);
    EXPECT_FALSE(faulty_.read(2).linear_velocity.allFinite());
    faulty_.break_now(Breakage::none);
    EXPECT_TRUE(faulty_.read(3).linear_velocity.allFinite());
}

TEST_F(FaultyDeviceTest, StandsStillWhenItStalls)
{
    const DeviceState last = faulty_.read(0.2);
    faulty_.break_now(Breakage::stalled);
    EXPECT_EQ(faulty_.read(0.5).position, last.position);
    EXPECT_EQ(faulty_.read(0.6).time, 0.2);
    faulty_.break_now(Breakage::none);
    EXPECT_NE(faulty_.read(0.7).position, last.position);
}
} // namespace
} // namespace ode_predictive_space::haptics
