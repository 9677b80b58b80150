#include "ode_predictive_space/haptics/hand_path.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
TEST(HandPathDevice, FollowsThePath)
{
    HandPathSettings settings;
    settings.scale = 0.5;
    HandPathDevice device(settings, 3);
    HandPath path(settings, 3);
    device.open();
    for (int i = 0; i < 5000; ++i)
    {
        const DeviceState state = device.read(0.001 * i);
        ASSERT_EQ(state.position, path.position(0.001 * i));
        ASSERT_EQ(state.linear_velocity, path.velocity(0.001 * i));
        ASSERT_EQ(state.time, 0.001 * i);
        device.write({Vector3(0, 100, 0), Vector3::Zero()});
    }
    EXPECT_EQ(device.last_wrench().force, Vector3(0, 100, 0));
}

TEST(HandPathDevice, SaysWhatItCanDo)
{
    HandPathSettings settings;
    settings.centre = {1, 0, 0};
    HandPathDevice device(settings, 4);
    EXPECT_EQ(device.capabilities().force_axes, 0);
    EXPECT_EQ(device.capabilities().max_force, 0);
    device.open();
    for (int i = 0; i < 20000; ++i)
        ASSERT_TRUE(device.capabilities().workspace.contains(device.read(0.001 * i).position));
}
} // namespace
} // namespace ode_predictive_space::haptics
