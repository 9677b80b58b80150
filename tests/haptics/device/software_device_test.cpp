#include "ode_predictive_space/haptics/device.h"

#include "tests/support/error_of.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>

namespace ode_predictive_space::haptics
{
namespace
{
/// Its position is the time to which it was moved, in seconds.
class ClockDevice : public SoftwareDevice
{
public:
    ClockDevice() : SoftwareDevice(named()) {}

    bool broken = false;
    std::string reason;

protected:
    void start() override
    {
        if (broken)
            throw DeviceError(DeviceFault::missing_file, "clock: no hands");
    }
    DeviceState move_to(double seconds) override
    {
        DeviceState state;
        state.position.x() = seconds;
        return state;
    }
    std::string idle_reason() const override { return reason; }

private:
    static Capabilities named()
    {
        Capabilities capabilities;
        capabilities.name = "clock";
        return capabilities;
    }
};

template <typename Call> DeviceFault fault_of(Call call)
{
    const DeviceError error = error_of<DeviceError>(call);
    EXPECT_NE(std::string(error.what()).find("clock"), std::string::npos) << "it names the device";
    return error.fault();
}

TEST(DeviceError, EveryFaultHasANameOfItsOwn)
{
    std::set<std::string> names;
    for (int fault = 0; fault <= static_cast<int>(DeviceFault::not_open); ++fault)
        names.insert(name_of(static_cast<DeviceFault>(fault)));
    EXPECT_EQ(names.size(), static_cast<std::size_t>(DeviceFault::not_open) + 1);
    EXPECT_EQ(names.count("unknown"), 0u);
}

TEST(SoftwareDevice, CannotBeUsedUnlessOpen)
{
    ClockDevice device;
    EXPECT_FALSE(device.status().open);
    EXPECT_NE(device.status().explanation, "");
    EXPECT_EQ(fault_of([&] { device.read(0); }), DeviceFault::not_open);
    EXPECT_EQ(fault_of([&] { device.write(Wrench()); }), DeviceFault::not_open);
    device.open();
    EXPECT_TRUE(device.status().open);
    EXPECT_TRUE(device.status().ready);
    EXPECT_EQ(device.status().explanation, "");
    device.read(0);
    device.close();
    EXPECT_EQ(fault_of([&] { device.read(1); }), DeviceFault::not_open);
}

TEST(SoftwareDevice, StaysClosedWhenItCannotStart)
{
    ClockDevice device;
    device.broken = true;
    EXPECT_EQ(fault_of([&] { device.open(); }), DeviceFault::missing_file);
    EXPECT_FALSE(device.status().open);
    device.broken = false;
    device.open();
    EXPECT_TRUE(device.status().open);
}

TEST(SoftwareDevice, TimeBeginsAtTheFirstReadAfterOpen)
{
    ClockDevice device;
    device.open();
    EXPECT_EQ(device.read(100).position.x(), 0);
    EXPECT_EQ(device.read(100.5).position.x(), 0.5);
    EXPECT_EQ(device.read(100.5).time, 100.5);
    device.open();
    EXPECT_EQ(device.read(101).position.x(), 1) << "it was open already";
    device.close();
    device.open();
    EXPECT_EQ(device.read(103).position.x(), 0);
}

TEST(SoftwareDevice, TimeDoesNotGoBack)
{
    ClockDevice device;
    device.open();
    EXPECT_THROW(device.read(std::nan("")), std::invalid_argument);
    device.read(1);
    device.read(3);
    EXPECT_EQ(device.read(2).position.x(), 2) << "as at 3 s";
    EXPECT_THROW(device.read(std::nan("")), std::invalid_argument);
    EXPECT_THROW(device.read(std::numeric_limits<double>::infinity()), std::invalid_argument);
    EXPECT_EQ(device.read(4).position.x(), 3);
}

TEST(SoftwareDevice, RemembersTheLastWrench)
{
    ClockDevice device;
    device.open();
    EXPECT_EQ(device.last_wrench().force, Vector3::Zero());
    device.write({Vector3(1, 2, 3), Vector3(4, 5, 6)});
    EXPECT_EQ(device.last_wrench().force, Vector3(1, 2, 3));
    EXPECT_EQ(device.last_wrench().torque, Vector3(4, 5, 6));
    EXPECT_EQ(fault_of([&] { device.write({Vector3::Zero(), Vector3(0, std::nan(""), 0)}); }), DeviceFault::failed);
    EXPECT_EQ(device.last_wrench().force, Vector3::Zero());
    device.write({Vector3(1, 2, 3), Vector3::Zero()});
    device.close();
    EXPECT_EQ(device.last_wrench().force, Vector3::Zero());
}

TEST(SoftwareDevice, SaysWhyItIsNotReady)
{
    ClockDevice device;
    device.open();
    device.reason = "clock: it has stopped";
    EXPECT_TRUE(device.status().open);
    EXPECT_FALSE(device.status().ready);
    EXPECT_EQ(device.status().explanation, "clock: it has stopped");
}
} // namespace
} // namespace ode_predictive_space::haptics
