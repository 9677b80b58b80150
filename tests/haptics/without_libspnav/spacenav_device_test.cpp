#include "ode_predictive_space/haptics/drivers.h"

#include "tests/support/error_of.h"

#include <gtest/gtest.h>

using namespace ode_predictive_space::haptics;

TEST(SpacenavWithoutLibspnav, SaysWhyItCannotBeOpened)
{
    SpacenavDevice device;
    EXPECT_EQ(device.capabilities().force_axes, 0);
    const auto error = ode_predictive_space::error_of<DeviceError>([&] { device.open(); });
    EXPECT_EQ(error.fault(), DeviceFault::missing_library);
    EXPECT_PRED_FORMAT2(testing::IsSubstring, "libspnav", error.what());
    EXPECT_FALSE(device.status().open);
}
