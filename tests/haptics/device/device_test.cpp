#include "ode_predictive_space/haptics/device.h"

#include <gtest/gtest.h>
#include <set>
#include <string>

using namespace ode_predictive_space::haptics;

TEST(DeviceError, EveryFaultHasANameOfItsOwn)
{
    std::set<std::string> names;
    for (int fault = 0; fault <= static_cast<int>(DeviceFault::not_open); ++fault)
        names.insert(name_of(static_cast<DeviceFault>(fault)));
    EXPECT_EQ(names.size(), static_cast<std::size_t>(DeviceFault::not_open) + 1);
    EXPECT_EQ(names.count("unknown"), 0u);
}
