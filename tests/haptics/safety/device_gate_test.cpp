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
class NosyDevice : public ScriptedDevice
{
public:
    NosyDevice() : ScriptedDevice([](double) { return Vector3(Vector3::Zero()); }) {}

    void write(const Wrench &wrench) override
    {
        if (before)
            std::exchange(before, {})();
        ScriptedDevice::write(wrench);
        if (inside)
            inside();
    }

    std::function<void()> before; ///< called once, before a write takes effect
    std::function<void()> inside;
};

class DeviceGateTest : public testing::Test
{
protected:
    DeviceGateTest()
    {
        device_.open();
        device_.read(0);
    }

    NosyDevice device_;
    DeviceGate gate_{device_};
};

TEST_F(DeviceGateTest, AfterTheGuardNoForceIsWrittenUntilTheServoHasNoticed)
{
    gate_.write(push(1));
    EXPECT_TRUE(gate_.close_with_zero(0));
    EXPECT_EQ(device_.last_wrench().force.z(), 0);
    EXPECT_FALSE(gate_.write(push(2))) << "what was computed before the stall";
    EXPECT_FALSE(gate_.write({Vector3::Zero(), Vector3(1, 0, 0)})) << "nor a torque";
    EXPECT_EQ(device_.last_wrench().force.z(), 0);
    EXPECT_TRUE(gate_.notice_closing());
    EXPECT_FALSE(gate_.notice_closing());
    EXPECT_TRUE(gate_.write(push(3)));
    EXPECT_EQ(device_.last_wrench().force.z(), 3);
}

TEST_F(DeviceGateTest, NobodyEntersWhileAnotherIsInside)
{
    bool closed = true;
    device_.inside = [&] { closed = gate_.close_with_zero(0); };
    EXPECT_TRUE(gate_.write(push(1)));
    EXPECT_FALSE(closed);

    bool read = true;
    bool written = true;
    device_.inside = [&] {
        DeviceState state;
        read = gate_.read(1, state);
        written = gate_.write(push(2));
    };
    EXPECT_TRUE(gate_.close_with_zero(0));
    EXPECT_FALSE(read);
    EXPECT_FALSE(written);
}

TEST_F(DeviceGateTest, ZeroIsWrittenWhenTheGuardFoundTheDeviceTaken)
{
    device_.inside = [&] { gate_.close_with_zero(0); };
    EXPECT_TRUE(gate_.write(push(1)));
    device_.inside = {};
    EXPECT_FALSE(gate_.write(push(2)));
    EXPECT_EQ(device_.last_wrench().force.z(), 1) << "the guard could not";
    EXPECT_TRUE(gate_.write(push(0)));
    EXPECT_EQ(device_.last_wrench().force.z(), 0);
    EXPECT_TRUE(gate_.notice_closing()) << "and it is still closed to forces";
}

TEST_F(DeviceGateTest, TellsWhenTheGuardTookTheForce)
{
    gate_.close_with_zero(3.5);
    EXPECT_EQ(gate_.last_zero(), 3.5);
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
    double force_after_shut = 1;
    device_.inside = [&, first = true]() mutable {
        if (std::exchange(first, false))
        {
            gate_.shut();
            force_after_shut = device_.last_wrench().force.z();
        }
    };
    EXPECT_TRUE(gate_.write(push(1)));
    EXPECT_EQ(force_after_shut, 0) << "this call may never return";
    EXPECT_FALSE(gate_.write(push(2)));
}

/// Another thread shuts its gate before a write takes effect.
TEST_F(DeviceGateTest, WhatIsWrittenAfterItWasShutGoesAtOnce)
{
    double force_after_shut = 1;
    gate_.write(push(1));
    device_.before = [&] {
        std::thread([&] { gate_.shut(); }).join();
        force_after_shut = device_.last_wrench().force.z();
    };
    gate_.write(push(2));
    EXPECT_EQ(force_after_shut, 0) << "though the device was taken";
    EXPECT_EQ(device_.last_wrench().force.z(), 0);
}

TEST_F(DeviceGateTest, TwoThreadsAreNeverInsideAtOnce)
{
    int inside = 0; // not atomic: the gate orders it, or ThreadSanitizer reports a race
    bool crowded = false;
    device_.inside = [&] {
        crowded = crowded || inside != 0;
        ++inside;
        --inside;
    };
    std::atomic<bool> over{false};
    std::thread guard([&] {
        while (!over)
            gate_.close_with_zero(0);
    });
    for (int i = 0; i < 20000; ++i)
    {
        gate_.notice_closing();
        gate_.write(push(i));
    }
    over = true;
    guard.join();
    EXPECT_FALSE(crowded);
}
} // namespace
} // namespace ode_predictive_space::haptics
