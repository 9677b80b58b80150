#include "ode_predictive_space/haptics/safety.h"
#include "ode_predictive_space/haptics/safety/safety_stage.h"
#include "ode_predictive_space/haptics/virtual_device.h"

#include <gtest/gtest.h>

#include "tests/haptics/support/constants.h"

namespace ode_predictive_space::haptics
{
namespace
{
const Capabilities &desktop()
{
    return device_preset("PHANToM Desktop");
}

Rendering rendering_of(double stiffness, double rate = 1000)
{
    Rendering rendering;
    rendering.stiffness = stiffness;
    rendering.rate = rate;
    return rendering;
}

TEST(Stability, WhatTheDeviceCanRenderIsFine)
{
    for (const double stiffness : {0.0, 500.0, 1000.0})
    {
        const StabilityVerdict verdict = check_stability(desktop(), rendering_of(stiffness));
        EXPECT_EQ(verdict.outcome, StabilityOutcome::fine);
        EXPECT_EQ(verdict.stiffness, stiffness);
        EXPECT_EQ(verdict.reason, "");
    }
}

TEST(Stability, ASlowerLoopRendersLessAFasterOneNotMore)
{
    EXPECT_EQ(check_stability(desktop(), rendering_of(3000, 500)).stiffness, 500);
    EXPECT_EQ(
        check_stability(desktop(), rendering_of(3000, 500)).reason,
        "A stiffness of 3000 N/m is above the 500 N/m that PHANToM Desktop can render at 500 Hz; 500 N/m is used.");
    EXPECT_EQ(check_stability(desktop(), rendering_of(3000, 4000)).stiffness, 1000);
}

TEST(Stability, AFasterLoopWithADelayRendersNotMore)
{
    Rendering rendering = rendering_of(3000, 4000);
    rendering.delay = 0.0001;
    EXPECT_EQ(check_stability(desktop(), rendering).stiffness, 1000);
}

TEST(Stability, OfADampingThatIsKnownTheStiffnessIsPassive)
{
    Rendering rendering = rendering_of(900);
    rendering.device_damping = 0.4;
    StabilityVerdict verdict = check_stability(desktop(), rendering);
    EXPECT_EQ(verdict.outcome, StabilityOutcome::clamped);
    EXPECT_DOUBLE_EQ(verdict.stiffness, 800); // 2 b / T
    EXPECT_EQ(verdict.reason,
              "A stiffness of 900 N/m is above the 800 N/m that are passive at 1000 Hz with 0.4 N s/m in the "
              "device; 800 N/m is used.");

    rendering.damping = 0.1; // is subtracted from b
    verdict = check_stability(desktop(), rendering);
    EXPECT_NEAR(verdict.stiffness, 600, 1e-9);
    EXPECT_EQ(verdict.damping, 0.1);

    rendering.delay = 0.001; // a whole period: T / 2 becomes 3 T / 2
    verdict = check_stability(desktop(), rendering);
    EXPECT_NEAR(verdict.stiffness, 200, 1e-9);
    EXPECT_NE(verdict.reason.find(" in the device and a delay of 1 ms; "), std::string::npos) << verdict.reason;

    rendering = rendering_of(3000);
    rendering.device_damping = 100; // the device's own limit is lower
    EXPECT_EQ(check_stability(desktop(), rendering).stiffness, 1000);
}

TEST(Stability, DampingIsClampedToo)
{
    Rendering rendering = rendering_of(3000);
    rendering.damping = 12;
    const StabilityVerdict verdict = check_stability(desktop(), rendering);
    EXPECT_EQ(verdict.outcome, StabilityOutcome::clamped);
    EXPECT_EQ(verdict.damping, 5);
    EXPECT_EQ(verdict.stiffness, 1000);
    EXPECT_EQ(verdict.reason,
              "A damping of 12 N s/m is above the 5 N s/m that PHANToM Desktop can render; 5 N s/m is used. "
              "A stiffness of 3000 N/m is above the 1000 N/m that PHANToM Desktop can render; 1000 N/m is used.");
    EXPECT_EQ(renderable(desktop(), rendering).damping, 5);
    rendering.device_damping = 3;
    EXPECT_EQ(renderable(desktop(), rendering).damping, 0) << "5 N s/m would not be passive";
    EXPECT_EQ(renderable(desktop(), rendering).stiffness, 1000);
}

TEST(Stability, LimitsThatAreNotKnownDoNotCount)
{
    Rendering rendering = rendering_of(1e6);
    rendering.damping = 1e3;
    const StabilityVerdict verdict = check_stability(Capabilities(), rendering);
    EXPECT_EQ(verdict.outcome, StabilityOutcome::fine);
    EXPECT_EQ(verdict.stiffness, 1e6);
}

TEST(Stability, ADeviceThatCannotPushRendersAnything)
{
    Capabilities mouse = desktop();
    mouse.force_axes = 0;
    EXPECT_EQ(check_stability(mouse, rendering_of(3000)).outcome, StabilityOutcome::fine);
    EXPECT_EQ(renderable(mouse, rendering_of(3000)).stiffness, 3000);
}

TEST(Stability, NonsenseIsRefusedWithTheReason)
{
    const auto expect_refused = [](const Rendering &rendering, const char *word) {
        const StabilityVerdict verdict = check_stability(desktop(), rendering);
        EXPECT_EQ(verdict.outcome, StabilityOutcome::refused) << word;
        EXPECT_EQ(verdict.stiffness, 0);
        EXPECT_EQ(verdict.damping, 0);
        EXPECT_NE(verdict.reason.find(word), std::string::npos) << verdict.reason;
        EXPECT_EQ(verdict.reason.back(), '.');
    };
    for (const double bad : {-1.0, nan, infinity})
    {
        Rendering rendering = rendering_of(500);
        rendering.stiffness = bad;
        expect_refused(rendering, "stiffness");
        rendering = rendering_of(500);
        rendering.damping = bad;
        expect_refused(rendering, "damping");
        rendering = rendering_of(500);
        rendering.rate = bad;
        expect_refused(rendering, "rate");
        rendering = rendering_of(500);
        rendering.delay = bad;
        expect_refused(rendering, "delay");
        rendering = rendering_of(500);
        rendering.device_damping = bad;
        expect_refused(rendering, "device");
    }
    expect_refused(rendering_of(500, 0), "rate");
}

TEST(Stability, MoreDampingThanTheDeviceHasIsRefused)
{
    Rendering rendering = rendering_of(500);
    rendering.device_damping = 0.4;
    rendering.damping = 0.4;
    EXPECT_EQ(check_stability(desktop(), rendering).outcome, StabilityOutcome::refused);
    EXPECT_EQ(
        check_stability(desktop(), rendering).reason,
        "No stiffness is passive with a damping of 0.4 N s/m, as the device's own damping, 0.4 N s/m, is not larger.");
    rendering.stiffness = 0;
    EXPECT_EQ(check_stability(desktop(), rendering).outcome, StabilityOutcome::refused) << "without stiffness, too";
    rendering.damping = 0;
    rendering.device_damping = 0;
    EXPECT_EQ(check_stability(desktop(), rendering).outcome, StabilityOutcome::fine); // without stiffness and damping
}
} // namespace
} // namespace ode_predictive_space::haptics
