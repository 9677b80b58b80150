#include "ode_predictive_space/haptics/drivers.h"

#include "tests/haptics/stand_ins/fake_hd_control.h"
#include "tests/support/error_of.h"

#include <gtest/gtest.h>

using namespace ode_predictive_space::haptics;
using ode_predictive_space::error_of;
using testing::IsSubstring;

namespace
{
bool ends_with(const std::string &text, const std::string &end)
{
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

class OpenHaptics : public testing::Test
{
protected:
    static DeviceError error_of_opening(const OpenHapticsSettings &settings)
    {
        OpenHapticsDevice device(settings);
        const DeviceError error = error_of<DeviceError>([&] { device.open(); });
        EXPECT_FALSE(device.status().open || device.status().ready) << "after an open() that failed";
        return error;
    }

    FakeHdControl fake;
    OpenHapticsDevice device{{FAKE_HD, ""}};
};
} // namespace

TEST_F(OpenHaptics, TellsWhatTheDeviceCanDoInMetresAndNewtons)
{
    device.open();
    const Capabilities &capabilities = device.capabilities();
    EXPECT_EQ(capabilities.name, "Stand-in Arm");
    EXPECT_EQ(capabilities.input_axes, 6);
    EXPECT_EQ(capabilities.force_axes, 3);
    EXPECT_DOUBLE_EQ(capabilities.max_force, 3.3);
    EXPECT_DOUBLE_EQ(capabilities.max_stiffness, 500);
    EXPECT_DOUBLE_EQ(capabilities.max_damping, 3);
    EXPECT_DOUBLE_EQ(capabilities.rate, 1000);
    EXPECT_TRUE(capabilities.workspace.min().isApprox(Vector3(-0.08, -0.06, -0.04)));
    EXPECT_TRUE(capabilities.workspace.max().isApprox(Vector3(0.08, 0.12, 0.05)));
}

TEST_F(OpenHaptics, TakesOneKilohertzWhereTheLibraryTellsNoRate)
{
    fake.set_told_rate(0);
    device.open();
    EXPECT_DOUBLE_EQ(device.capabilities().rate, 1000);
}

TEST_F(OpenHaptics, KeepsTheLibrarysLimitsOn)
{
    device.open();
    EXPECT_TRUE(fake.is_enabled(0x4000)) << "force output";
    EXPECT_TRUE(fake.is_enabled(0x4001)) << "clamping";
    EXPECT_TRUE(fake.is_enabled(0x4002)) << "ramping";
}

TEST_F(OpenHaptics, TellsThePoseInMetresAndTheButtons)
{
    // The handle is turned by 90 degrees about z: its x axis, the first column, points up.
    fake.set_motion([](double, FakeHdPose *pose) {
        *pose = {
            {10, 20, -30}, {100, 0, -50}, {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 20, -30, 1}, {0.1, 0.2, 0.3}, 5};
    });
    device.open();
    const DeviceState state = device.read(2.5);
    EXPECT_TRUE(state.position.isApprox(Vector3(0.01, 0.02, -0.03)));
    EXPECT_TRUE(state.linear_velocity.isApprox(Vector3(0.1, 0, -0.05)));
    EXPECT_TRUE(state.angular_velocity.isApprox(Vector3(0.1, 0.2, 0.3)));
    EXPECT_TRUE((state.orientation * Vector3::UnitX()).isApprox(Vector3::UnitY()));
    EXPECT_TRUE((state.orientation * Vector3::UnitY()).isApprox(-Vector3::UnitX()));
    EXPECT_EQ(state.buttons, 5u);
    EXPECT_DOUBLE_EQ(state.time, 2.5);
}

TEST_F(OpenHaptics, FollowsTheMotionFrameByFrame)
{
    fake.set_motion([](double seconds, FakeHdPose *pose) { pose->position[0] = 1000 * seconds; });
    device.open();
    fake.pause();
    const double start = device.read(0).position.x();
    fake.step(3);
    EXPECT_NEAR(device.read(0.003).position.x() - start, 0.003, 1e-12);
}

TEST_F(OpenHaptics, KeepsTheTimeOfAStateThatItHasToldBefore)
{
    device.open();
    fake.pause();
    EXPECT_DOUBLE_EQ(device.read(1.000).time, 1.000);
    EXPECT_DOUBLE_EQ(device.read(1.001).time, 1.000);
    fake.step(1);
    EXPECT_DOUBLE_EQ(device.read(1.002).time, 1.002);
}

TEST_F(OpenHaptics, SaysWhichDeviceIsNotThere)
{
    EXPECT_NO_THROW(OpenHapticsDevice({FAKE_HD, "Left Arm"}).open());
    const DeviceError error = error_of_opening({FAKE_HD, "Right Arm"});
    EXPECT_EQ(error.fault(), DeviceFault::not_found);
    EXPECT_PRED_FORMAT2(IsSubstring, "Right Arm", error.what());
    EXPECT_PRED_FORMAT2(IsSubstring, "HD_BAD_HANDLE (0x104, internal code -1)", error.what());
}

TEST_F(OpenHaptics, RefusesADeviceThatHasToBeCalibratedByHand)
{
    fake.set_calibration(0x5002, 0x5002);
    const DeviceError error = error_of_opening({FAKE_HD, ""});
    EXPECT_EQ(error.fault(), DeviceFault::not_calibrated);
    EXPECT_PRED_FORMAT2(IsSubstring, "inkwell", error.what());
    EXPECT_PRED_FORMAT2(IsSubstring, "hdStopScheduler hdUnschedule hdDisable hdDisableDevice", fake.calls());
}

TEST_F(OpenHaptics, UpdatesTheCalibrationWhereTheLibraryAsksForIt)
{
    fake.set_calibration(0x5001, 0x5000);
    EXPECT_NO_THROW(device.open());
    EXPECT_PRED_FORMAT2(IsSubstring, "hdCheckCalibration hdUpdateCalibration hdCheckCalibration", fake.calls());
}

TEST_F(OpenHaptics, UndoesWhatWasDoneWhereAStepOfOpeningFails)
{
    struct Step
    {
        const char *function;
        std::uint32_t code;
        DeviceFault fault;
        const char *undone;
    };
    const Step steps[] = {
        {"hdInitDevice", 0x302, DeviceFault::not_found, "hdInitDevice "},
        {"hdInitDevice", 0x600, DeviceFault::failed, "hdInitDevice "},
        {"hdGetDoublev", 0x300, DeviceFault::lost, "hdInitDevice hdDisable hdDisableDevice "},
        {"hdScheduleAsynchronous", 0x501, DeviceFault::failed, "hdUnschedule hdDisable hdDisableDevice "},
        {"hdEnable", 0x102, DeviceFault::failed, "hdEnable hdUnschedule hdDisable hdDisableDevice "},
        {"hdStartScheduler", 0x304, DeviceFault::lost, "hdStopScheduler hdUnschedule hdDisable hdDisableDevice "},
        {"hdEndFrame", 0x302, DeviceFault::lost, "hdStopScheduler hdUnschedule hdDisable hdDisableDevice "},
    };
    for (const Step &step : steps)
    {
        FakeHdControl anew;
        anew.fail(step.function, step.code, 42, 1);
        const DeviceError error = error_of_opening({FAKE_HD, ""});
        EXPECT_EQ(error.fault(), step.fault) << step.function;
        EXPECT_PRED_FORMAT2(IsSubstring, "internal code 42", error.what()) << step.function;
        EXPECT_TRUE(ends_with(anew.calls(), step.undone)) << anew.calls();
        EXPECT_TRUE(anew.playing().isZero());
    }
    EXPECT_NO_THROW(device.open()) << "nothing is left that would be in the way";
}

TEST_F(OpenHaptics, GivesUpWhereTheServoThreadDoesNotRun)
{
    fake.pause();
    const DeviceError error = error_of_opening({FAKE_HD, ""});
    EXPECT_EQ(error.fault(), DeviceFault::failed);
    EXPECT_TRUE(ends_with(fake.calls(), "hdStopScheduler hdUnschedule hdDisable hdDisableDevice ")) << fake.calls();
}

TEST_F(OpenHaptics, IsTheOnlyOneOfItsProgram)
{
    device.open();
    const DeviceError error = error_of_opening({FAKE_HD, ""});
    EXPECT_EQ(error.fault(), DeviceFault::permission_denied);
    EXPECT_PRED_FORMAT2(IsSubstring, "another device is open", error.what());
    EXPECT_NO_THROW(device.read(0)) << "the first one goes on";

    fake.fail("hdDisableDevice", 0x302, 1, 1);
    device.close();
    OpenHapticsDevice second({FAKE_HD, ""});
    EXPECT_NO_THROW(second.open()) << "whatever error the first one has left";
}

TEST_F(OpenHaptics, WantsToBeOpen)
{
    EXPECT_FALSE(device.status().open);
    EXPECT_EQ(error_of<DeviceError>([&] { device.write({}); }).fault(), DeviceFault::not_open);
    EXPECT_THROW(device.read(0), DeviceError);
    device.close();

    device.open();
    device.open();
    EXPECT_TRUE(device.status().open && device.status().ready);
    device.close();
    EXPECT_THROW(device.read(0), DeviceError);
    EXPECT_FALSE(device.status().open);
    EXPECT_FALSE(device.status().explanation.empty());
}
