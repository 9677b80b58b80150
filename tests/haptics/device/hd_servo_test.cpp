// Forces and errors in the servo thread, frame by frame; the device runs on a stand-in for the vendor's library.

#include "ode_predictive_space/haptics/device/hd_servo.h"

#include "ode_predictive_space/haptics/drivers.h"
#include "tests/haptics/stand_ins/fake_hd_control.h"
#include "tests/support/error_of.h"
#include "tests/support/eventually.h"

#include <chrono>
#include <gtest/gtest.h>
#include <limits>
#include <memory>

using namespace ode_predictive_space::haptics;
using testing::IsSubstring;

namespace
{
const Vector3 some_force(0.5, -1, 2);

/// Counts at 1000 Hz.
constexpr int frames_until_stale = 10;
constexpr int frames_of_a_pause = 100;

const std::uint32_t passing_errors[] = {0x200, 0x201, 0x202, 0x203, 0x204};
const std::uint32_t errors_of_the_device[] = {0x104, 0x300, 0x301, 0x302, 0x303, 0x304};
const std::uint32_t other_errors[] = {0x100, 0x101, 0x102, 0x103, 0x402, 0x501, 0x600, 0x999};

class HdServoTest : public testing::Test
{
protected:
    /// Opens the device and pauses the servo thread, which then runs the test's steps only.
    void open()
    {
        device.open();
        fake.pause();
        device.read(0);
    }

    /// While the device renders a force, hdEndFrame reports an error.
    void open_and_fail(std::uint32_t code, int times = 1)
    {
        open();
        device.write({some_force, Vector3::Zero()});
        fake.step(1);
        ASSERT_EQ(fake.playing(), some_force);
        fake.fail("hdEndFrame", code, 42, times);
        fake.step(2);
    }

    void write_for(int frames)
    {
        for (int frame = 0; frame < frames; ++frame)
        {
            device.write({some_force, Vector3::Zero()});
            fake.step(1);
        }
    }

    DeviceError error_of_read(double time)
    {
        return ode_predictive_space::error_of<DeviceError>([&] { device.read(time); });
    }

    void expect_end_by(std::uint32_t code, DeviceFault fault)
    {
        open_and_fail(code);
        EXPECT_TRUE(fake.playing().isZero()) << std::hex << code;
        for (int i = 0; i < 2; ++i)
        {
            const DeviceError error = error_of_read(0.001);
            EXPECT_EQ(error.fault(), fault);
            EXPECT_PRED_FORMAT2(IsSubstring, name_of_hd_error(code), error.what());
            EXPECT_THROW(device.write({some_force, Vector3::Zero()}), DeviceError);
            fake.step(2 * frames_of_a_pause);
        }
        EXPECT_TRUE(fake.playing().isZero()) << "for good";
        EXPECT_FALSE(device.status().ready);
        EXPECT_PRED_FORMAT2(IsSubstring, name_of_hd_error(code), device.status().explanation);
        fake.resume();
        device.close();
    }

    FakeHdControl fake;
    OpenHapticsDevice device{{FAKE_HD, ""}};
};
} // namespace

TEST_F(HdServoTest, RendersWhatWasWrittenLast)
{
    open();
    EXPECT_TRUE(fake.playing().isZero()) << "before the first write";
    device.write({Vector3(3, 3, 3), Vector3::Zero()});
    device.write({some_force, Vector3::Zero()});
    fake.step(1);
    EXPECT_EQ(fake.playing(), some_force);
}

TEST_F(HdServoTest, TakesAForceBackThatNobodyRenewsByTheDevicesRate)
{
    for (const int rate : {1000, 500})
    {
        fake.set_told_rate(rate);
        open();
        device.write({some_force, Vector3::Zero()});
        fake.step(frames_until_stale * rate / 1000);
        EXPECT_EQ(fake.playing(), some_force);
        fake.step(1);
        EXPECT_TRUE(fake.playing().isZero());
        write_for(2 * frames_until_stale);
        EXPECT_EQ(fake.playing(), some_force) << "renewed in each frame";
        fake.resume();
        device.close();
    }
}

TEST_F(HdServoTest, RendersNoForceThatIsNotFinite)
{
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    {
        open();
        write_for(1);
        EXPECT_THROW(device.write({Vector3(0, bad, 0), Vector3::Zero()}), DeviceError);
        fake.step(1);
        EXPECT_TRUE(fake.playing().isZero());
        write_for(1);
        EXPECT_EQ(fake.playing(), some_force);
        fake.resume();
        device.close();
    }
}

/// On a busy machine the servo thread may not run within the device's wait; then another device is ended.
TEST_F(HdServoTest, SetsZeroAndSeesItBeforeItStops)
{
    constexpr std::chrono::milliseconds longest_wait(100);
    for (const bool by_destructor : {false, true})
    {
        bool rested = false;
        for (int attempt = 0; attempt < 100 && !rested; ++attempt)
        {
            auto local = std::make_unique<OpenHapticsDevice>(OpenHapticsSettings{FAKE_HD, ""});
            local->open();
            ASSERT_TRUE(ode_predictive_space::eventually([&] {
                local->write({some_force, Vector3::Zero()});
                return fake.playing() == some_force;
            }));
            const auto begin = std::chrono::steady_clock::now();
            by_destructor ? local.reset() : local->close();
            rested = fake.playing_at_stop().isZero() && fake.frames_without_force_at_stop() >= 2;
            ASSERT_TRUE(rested || std::chrono::steady_clock::now() - begin >= longest_wait) << "it did not wait";
        }
        EXPECT_TRUE(rested);
    }
}

TEST_F(HdServoTest, SwitchesTheForceOffWhereTheServoThreadStandsStill)
{
    open();
    write_for(1);
    device.close();
    EXPECT_EQ(fake.playing_at_stop(), some_force) << "it plays on when nobody sets another";
    EXPECT_FALSE(fake.is_enabled(0x4000));
    EXPECT_TRUE(fake.playing().isZero());
    EXPECT_PRED_FORMAT2(IsSubstring, "hdStopScheduler hdUnschedule hdDisable hdDisableDevice", fake.calls());
}

TEST_F(HdServoTest, PausesAfterAnErrorOfForces)
{
    for (const std::uint32_t code : passing_errors)
    {
        open_and_fail(code);
        EXPECT_TRUE(fake.playing().isZero()) << name_of_hd_error(code);
        EXPECT_FALSE(device.status().ready);
        EXPECT_TRUE(device.status().open);
        EXPECT_PRED_FORMAT2(IsSubstring, name_of_hd_error(code), device.status().explanation);

        const DeviceError error = error_of_read(0.001);
        EXPECT_EQ(error.fault(), DeviceFault::failed);
        EXPECT_PRED_FORMAT2(IsSubstring, name_of_hd_error(code), error.what());
        EXPECT_PRED_FORMAT2(IsSubstring, "internal code 42", error.what());
        EXPECT_THROW(device.read(0.001), DeviceError) << "as long as it lasts";

        // One frame of the pause has passed.
        write_for(frames_of_a_pause - 1);
        EXPECT_TRUE(fake.playing().isZero());
        write_for(1);
        EXPECT_EQ(fake.playing(), some_force);
        EXPECT_TRUE(device.status().ready);
        EXPECT_EQ(device.status().explanation, "");
        EXPECT_NO_THROW(device.read(0.2));
        fake.resume();
        device.close();
    }
}

TEST_F(HdServoTest, TellsThePauseToWhoeverWritesFirst)
{
    open_and_fail(0x201);
    EXPECT_THROW(device.write({some_force, Vector3::Zero()}), DeviceError);
    EXPECT_NO_THROW(device.write(Wrench()));
}

TEST_F(HdServoTest, PausesForAsLongAsMotorsAreWarm)
{
    open_and_fail(0x200, -1);
    EXPECT_THROW(device.read(0.001), DeviceError);
    write_for(3 * frames_of_a_pause);
    EXPECT_TRUE(fake.playing().isZero());
    EXPECT_THROW(device.read(0.002), DeviceError) << "or the full force would be requested when it comes back";
    EXPECT_FALSE(device.status().ready);
}

TEST_F(HdServoTest, IsLostAfterAnErrorOfTheDevice)
{
    for (const std::uint32_t code : errors_of_the_device)
    {
        expect_end_by(code, DeviceFault::lost);
        device.open();
        EXPECT_NO_THROW(device.read(1)) << "after it was opened anew";
        device.close();
    }
}

TEST_F(HdServoTest, FailsForGoodAfterAnyOtherError)
{
    for (const std::uint32_t code : other_errors)
        expect_end_by(code, DeviceFault::failed);
}

TEST_F(HdServoTest, TellsTheGraverOfTwoErrorsAndTheOlderOfTwoThatAreAlike)
{
    constexpr std::uint32_t pairs[][2] = {{0x300, 0x200}, {0x200, 0x300}, {0x300, 0x302}};
    for (const auto &codes : pairs)
    {
        open();
        fake.fail("hdGetIntegerv", codes[0], 1, 1);
        fake.fail("hdEndFrame", codes[1], 2, 1);
        fake.step(1);
        const DeviceError error = error_of_read(0.001);
        EXPECT_EQ(error.fault(), DeviceFault::lost);
        EXPECT_PRED_FORMAT2(IsSubstring, "HD_DEVICE_FAULT", error.what());
        fake.resume();
        device.close();
    }
}

TEST_F(HdServoTest, IsLostWhenTheServoThreadStandsStill)
{
    open();
    write_for(1);
    EXPECT_NO_THROW(device.read(1));
    EXPECT_NO_THROW(device.read(1.09));
    for (const double time : {1.2, 1.3})
    {
        EXPECT_EQ(error_of_read(time).fault(), DeviceFault::lost);
        EXPECT_THROW(device.write({some_force, Vector3::Zero()}), DeviceError);
    }
    EXPECT_FALSE(device.status().ready);
    fake.step(1);
    EXPECT_TRUE(fake.playing().isZero()) << "should it run again";
    EXPECT_THROW(device.read(1.4), DeviceError) << "until close()";
}
