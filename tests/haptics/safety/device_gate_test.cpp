#include "ode_predictive_space/haptics/safety/device_gate.h"

#include "tests/haptics/support/faulty_device.h"
#include "tests/haptics/support/scripted_device.h"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
class DeviceGateTest : public testing::Test
{
protected:
    DeviceGateTest() : device_([](double seconds) -> Vector3 { return {seconds, 0, 0}; })
    {
        device_.open();
        device_.read(0);
    }

    ScriptedDevice device_;
};

TEST_F(DeviceGateTest, AfterTheGuardNoForceIsWrittenUntilTheServoHasNoticed)
{
    DeviceGate gate(device_);
    gate.write(push(1));
    EXPECT_TRUE(gate.close_with_zero(0));
    EXPECT_EQ(device_.last_wrench().force.z(), 0);
    EXPECT_FALSE(gate.write(push(2))) << "what was computed before the stall";
    EXPECT_FALSE(gate.write({Vector3::Zero(), Vector3(1, 0, 0)})) << "nor a torque";
    EXPECT_EQ(device_.last_wrench().force.z(), 0);
    EXPECT_TRUE(gate.notice_closing());
    EXPECT_FALSE(gate.notice_closing());
    EXPECT_TRUE(gate.write(push(3)));
    EXPECT_EQ(device_.last_wrench().force.z(), 3);
}

class NosyDevice : public ScriptedDevice
{
public:
    NosyDevice() : ScriptedDevice([](double) { return Vector3(Vector3::Zero()); }) {}

    void write(const Wrench &wrench) override
    {
        ScriptedDevice::write(wrench);
        if (inside)
            inside();
    }

    std::function<void()> inside;
};

TEST_F(DeviceGateTest, NobodyEntersWhileAnotherIsInside)
{
    NosyDevice device;
    device.open();
    DeviceGate gate(device);
    bool closed = true;
    device.inside = [&] { closed = gate.close_with_zero(0); };
    EXPECT_TRUE(gate.write(push(1)));
    EXPECT_FALSE(closed);

    bool read = true;
    bool written = true;
    device.inside = [&] {
        DeviceState state;
        read = gate.read(1, state);
        written = gate.write(push(2));
    };
    EXPECT_TRUE(gate.close_with_zero(0));
    EXPECT_FALSE(read);
    EXPECT_FALSE(written);
}

TEST_F(DeviceGateTest, ZeroIsWrittenWhenTheGuardFoundTheDeviceTaken)
{
    NosyDevice device;
    device.open();
    DeviceGate gate(device);
    device.inside = [&] { gate.close_with_zero(0); };
    EXPECT_TRUE(gate.write(push(1)));
    device.inside = {};
    EXPECT_FALSE(gate.write(push(2)));
    EXPECT_EQ(device.last_wrench().force.z(), 1) << "the guard could not";
    EXPECT_TRUE(gate.write(push(0)));
    EXPECT_EQ(device.last_wrench().force.z(), 0);
    EXPECT_TRUE(gate.notice_closing()) << "and it is still closed to forces";
}

TEST_F(DeviceGateTest, TellsWhenTheGuardTookTheForce)
{
    DeviceGate gate(device_);
    gate.close_with_zero(3.5);
    EXPECT_EQ(gate.last_zero(), 3.5);
}

TEST_F(DeviceGateTest, ADeviceThatTakesNoZeroIsLetGoOf)
{
    FaultyDevice device(device_);
    DeviceGate gate(device);
    gate.write(push(1));
    device.break_now(Breakage::lost);
    EXPECT_THROW(gate.close_with_zero(0), DeviceError);
    EXPECT_FALSE(device_.status().open);
    EXPECT_TRUE(device.last_wrench().force.isZero(0));
    device.break_now(Breakage::none);
    EXPECT_FALSE(gate.write(push(2))) << "closed all the same";
}

TEST_F(DeviceGateTest, ShutInTheThreadThatIsInsideItWritesZeroAtOnce)
{
    NosyDevice device;
    device.open();
    DeviceGate gate(device);
    double force_after_shut = 1;
    device.inside = [&, first = true]() mutable {
        if (std::exchange(first, false))
        {
            gate.shut();
            force_after_shut = device.last_wrench().force.z();
        }
    };
    EXPECT_TRUE(gate.write(push(1)));
    EXPECT_EQ(force_after_shut, 0) << "this call may never return";
    EXPECT_FALSE(gate.write(push(2)));
}

/// Another thread shuts its gate before a write takes effect.
TEST_F(DeviceGateTest, WhatIsWrittenAfterItWasShutGoesAtOnce)
{
    class SlowDevice : public NosyDevice
    {
    public:
        void write(const Wrench &wrench) override
        {
            if (before)
                std::exchange(before, {})();
            NosyDevice::write(wrench);
        }

        std::function<void()> before;
    };
    SlowDevice device;
    device.open();
    DeviceGate gate(device);
    double force_after_shut = 1;
    gate.write(push(1));
    device.before = [&] {
        std::thread([&] { gate.shut(); }).join();
        force_after_shut = device.last_wrench().force.z();
    };
    gate.write(push(2));
    EXPECT_EQ(force_after_shut, 0) << "though the device was taken";
    EXPECT_EQ(device.last_wrench().force.z(), 0);
}

TEST_F(DeviceGateTest, TwoThreadsAreNeverInsideAtOnce)
{
    NosyDevice device;
    device.open();
    DeviceGate gate(device);
    int inside = 0; // not atomic: the gate orders it, or ThreadSanitizer reports a race
    bool crowded = false;
    device.inside = [&] {
        crowded = crowded || inside != 0;
        ++inside;
        --inside;
    };
    std::atomic<bool> over{false};
    std::thread guard([&] {
        while (!over)
            gate.close_with_zero(0);
    });
    for (int i = 0; i < 20000; ++i)
    {
        gate.notice_closing();
        gate.write(push(i));
    }
    over = true;
    guard.join();
    EXPECT_FALSE(crowded);
}
} // namespace
} // namespace ode_predictive_space::haptics
