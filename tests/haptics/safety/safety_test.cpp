#include "ode_predictive_space/haptics/safety.h"
#include "ode_predictive_space/haptics/safety/safety_stage.h"

#include <gtest/gtest.h>

#include "tests/haptics/support/constants.h"

namespace ode_predictive_space::haptics
{
namespace
{
SafetyLimits test_limits()
{
    SafetyLimits limits;
    limits.max_force = 8;
    limits.max_torque = 0.4;
    limits.max_force_rate = 2000;
    limits.max_torque_rate = 100;
    limits.max_speed = 1.5;
    limits.ramp_time = 0.1;
    limits.engage_force = 0.4;
    limits.engage_torque = 0.02;
    return limits;
}

Wrench wrench_of(double newtons, double newton_metres = 0)
{
    Wrench wrench;
    wrench.force = Vector3(0, newtons, 0);
    wrench.torque = Vector3(newton_metres, 0, 0);
    return wrench;
}

struct Loop
{
    explicit Loop(const SafetyLimits &limits) : stage(limits) {}

    Wrench tick(const Wrench &requested, double speed = 0, double allowance = 1)
    {
        time += dt;
        return stage.limit(requested, Vector3(speed, 0, 0), time, allowance);
    }

    /// Engages, and runs to the end of the ramp at this force.
    void settle(const Wrench &requested)
    {
        tick(Wrench());
        for (int i = 0; i < 300; ++i)
            tick(requested);
        ASSERT_EQ(tick(requested).force, requested.force);
    }

    SafetyStage stage;
    double time = 12;
};

TEST(SafetyLimits, FollowFromTheDevice)
{
    Capabilities desktop;
    desktop.force_axes = 3;
    desktop.max_force = 8;
    desktop.workspace = Eigen::AlignedBox3d(Vector3::Constant(-0.1), Vector3::Constant(0.1));
    const SafetyLimits limits = SafetyLimits::of(desktop);
    EXPECT_EQ(limits.max_force, 8);
    EXPECT_EQ(limits.max_torque, 0);
    EXPECT_DOUBLE_EQ(limits.max_force_rate, 1600);
    EXPECT_DOUBLE_EQ(limits.engage_force, 0.4);
    EXPECT_NEAR(limits.max_speed, 1.875 * 0.2 * std::sqrt(3) / 0.3, 1e-12);

    desktop.force_axes = 6;
    EXPECT_DOUBLE_EQ(SafetyLimits::of(desktop).max_torque, 0.4);
    EXPECT_DOUBLE_EQ(SafetyLimits::of(desktop).max_torque_rate, 80);
    EXPECT_DOUBLE_EQ(SafetyLimits::of(desktop).engage_torque, 0.02);
    desktop.force_axes = 0;
    EXPECT_EQ(SafetyLimits::of(desktop).max_force, 0);
    EXPECT_EQ(SafetyLimits::of(desktop).max_torque, 0);
}

TEST(SafetyLimits, OfAWorkspaceThatIsNotKnownAreForAnOrdinaryHand)
{
    Capabilities device;
    device.workspace.setEmpty();
    EXPECT_EQ(SafetyLimits::of(device).max_speed, 2);
    device.workspace = Eigen::AlignedBox3d(Vector3::Zero(), Vector3::Zero());
    EXPECT_EQ(SafetyLimits::of(device).max_speed, 2);
    device.workspace = Eigen::AlignedBox3d(Vector3::Constant(-infinity), Vector3::Constant(infinity));
    EXPECT_EQ(SafetyLimits::of(device).max_speed, 2);
}

TEST(SafetyLimits, ThatCannotBeAreRefused)
{
    double SafetyLimits::*const all[] = {&SafetyLimits::max_force,      &SafetyLimits::max_torque,
                                         &SafetyLimits::max_force_rate, &SafetyLimits::max_torque_rate,
                                         &SafetyLimits::max_speed,      &SafetyLimits::ramp_time,
                                         &SafetyLimits::engage_force,   &SafetyLimits::engage_torque};
    for (double SafetyLimits::*const limit : all)
        for (const double bad : {-1.0, nan, infinity})
        {
            SafetyLimits limits = test_limits();
            limits.*limit = bad;
            EXPECT_THROW(SafetyStage{limits}, std::invalid_argument);
        }
}

TEST(SafetyStage, TakesNonsenseForNothingAndComesBackSlowly)
{
    for (int what = 0; what < 5; ++what)
        for (const double bad : {nan, infinity, -infinity})
        {
            Loop loop(test_limits());
            loop.settle(wrench_of(3));
            Wrench requested = wrench_of(3);
            Vector3 velocity = Vector3::Zero();
            double allowance = 1;
            double *const places[] = {&requested.force.x(), &requested.torque.z(), &velocity.y(), &allowance,
                                      &loop.time};
            const double time = loop.time;
            *places[what] = bad;
            for (int i = 0; i < 5; ++i)
            {
                const Wrench wrench = loop.stage.limit(requested, velocity, loop.time, allowance);
                EXPECT_EQ(wrench.force.norm(), 0);
                EXPECT_EQ(wrench.torque.norm(), 0);
                EXPECT_TRUE(loop.stage.report().did(SafetyAction::not_finite));
                EXPECT_EQ(loop.stage.report().began(SafetyAction::not_finite), i == 0);
            }

            loop.time = time;
            double last = 0;
            for (int i = 0; i < 99; ++i) // 3 N over a ramp of 0.1 s
            {
                const double force = loop.tick(wrench_of(3)).force.y();
                EXPECT_NEAR(force - last, 3 * dt / 0.1, 1e-9);
                EXPECT_TRUE(loop.stage.report().did(SafetyAction::ramping));
                last = force;
            }
            loop.tick(wrench_of(3));
            EXPECT_EQ(loop.tick(wrench_of(3)).force.y(), 3);
            EXPECT_EQ(loop.stage.report().now, 0u);
        }
}

TEST(SafetyStage, ClampsToTheMaximumAndKeepsTheDirection)
{
    Loop loop(test_limits());
    loop.settle(wrench_of(1));
    Wrench requested;
    for (const double size : {20.0, 1e6, 1e160, 8e307})
    {
        requested.force = size * Vector3(1, 2, -1.5);
        requested.torque = size * Vector3(0, -1, 1);
        Wrench wrench;
        for (int i = 0; i < 50; ++i)
            wrench = loop.tick(requested);
        EXPECT_NEAR(wrench.force.norm(), 8, 1e-12);
        EXPECT_LE(wrench.force.norm(), 8);
        EXPECT_NEAR(wrench.force.normalized().dot(Vector3(1, 2, -1.5).normalized()), 1, 1e-12);
        EXPECT_NEAR(wrench.torque.norm(), 0.4, 1e-12);
        EXPECT_NEAR(wrench.torque.normalized().dot(Vector3(0, -1, 1).normalized()), 1, 1e-12);
        EXPECT_TRUE(loop.stage.report().did(SafetyAction::clamped));
    }
    loop.tick(wrench_of(1, 2));
    EXPECT_TRUE(loop.stage.report().did(SafetyAction::clamped)) << "the torque alone";
}

TEST(SafetyStage, LetsGoOfAHandThatIsTooFastAndComesBackSlowly)
{
    Loop loop(test_limits());
    loop.settle(wrench_of(3));
    EXPECT_EQ(loop.tick(wrench_of(3), 1.499).force.y(), 3);
    EXPECT_EQ(loop.tick(wrench_of(3), 1.501).force.y(), 0);
    EXPECT_TRUE(loop.stage.report().began(SafetyAction::too_fast));
    EXPECT_NEAR(loop.tick(wrench_of(3), 1.4).force.y(), 0.03, 1e-9);
    for (int i = 0; i < 49; ++i)
        loop.tick(wrench_of(3));
    EXPECT_NEAR(loop.tick(wrench_of(3)).force.y(), 51 * 0.03, 1e-9);
    EXPECT_EQ(loop.tick(wrench_of(3), 1e300).force.y(), 0); // its square overflows
}

TEST(SafetyStage, WaitsUntilTheForceWasSmallOnce)
{
    Loop loop(test_limits());
    for (int i = 0; i < 1000; ++i) // it starts with the probe in something
    {
        EXPECT_EQ(loop.tick(wrench_of(5)).force.y(), 0);
        EXPECT_TRUE(loop.stage.report().did(SafetyAction::waiting));
    }
    EXPECT_EQ(loop.tick(wrench_of(0.41)).force.y(), 0);
    EXPECT_EQ(loop.tick(wrench_of(0.1, 0.03)).force.y(), 0); // the torque is not small
    EXPECT_TRUE(loop.stage.report().did(SafetyAction::waiting));
    loop.tick(wrench_of(0.39, 0.019));
    EXPECT_FALSE(loop.stage.report().did(SafetyAction::waiting));
    EXPECT_LT(loop.tick(wrench_of(5)).force.y(), 0.11);
    for (int i = 0; i < 200; ++i)
        loop.tick(wrench_of(5));
    EXPECT_EQ(loop.tick(wrench_of(5)).force.y(), 5);

    loop.stage.reset();
    EXPECT_EQ(loop.tick(wrench_of(5)).force.y(), 0);
    EXPECT_TRUE(loop.stage.report().did(SafetyAction::waiting));
}

TEST(SafetyStage, ADeviceWithoutTorqueGetsNoneAndThatIsNoEvent)
{
    Capabilities device;
    device.max_force = 8;
    Loop loop(SafetyLimits::of(device));
    loop.tick(Wrench());
    Wrench wrench;
    for (int i = 0; i < 1000; ++i)
        wrench = loop.tick(wrench_of(3, 1));
    EXPECT_EQ(wrench.force.y(), 3);
    EXPECT_EQ(wrench.torque.norm(), 0);
    EXPECT_EQ(loop.stage.report().now, 0u);
}

TEST(SafetyStage, CanRenderNothingOnlyWhereBothMaximaAreZero)
{
    SafetyLimits limits = test_limits();
    limits.max_force = 0;
    Loop loop(limits);
    loop.tick(Wrench());
    for (int i = 0; i < 200; ++i)
        loop.tick(wrench_of(0, 0.3));
    EXPECT_EQ(loop.tick(wrench_of(0, 0.3)).torque.x(), 0.3);

    limits.max_torque = 0;
    Loop without(limits);
    without.tick(Wrench());
    EXPECT_FALSE(without.stage.report().did(SafetyAction::no_axes)) << "nothing was requested";
    without.tick(wrench_of(0, 0.3));
    EXPECT_TRUE(without.stage.report().did(SafetyAction::no_axes));
}

TEST(SafetyStage, HoldsBackWhatTheWatchdogDoesNotAllow)
{
    SafetyLimits limits = test_limits();
    limits.max_force_rate = 100; // 80 ms from the full force to zero
    Loop loop(limits);
    loop.settle(wrench_of(8));
    for (int i = 4; i >= 0; --i) // a fall may exceed the slew limit
    {
        EXPECT_LE(loop.tick(wrench_of(8), 0, i / 5.0).force.y(), 8 * i / 5.0);
        EXPECT_TRUE(loop.stage.report().did(SafetyAction::held_back));
    }
    EXPECT_NEAR(loop.tick(wrench_of(8), 0, 1).force.y(), 0.1, 1e-9); // a rise may not
    EXPECT_EQ(loop.tick(wrench_of(8), 0, -3).force.y(), 0);

    loop.settle(wrench_of(2));
    for (int i = 0; i < 100; ++i)
        loop.tick(wrench_of(2), 0, 0.25);
    EXPECT_NEAR(loop.tick(wrench_of(2), 0, 0.25).force.y(), 0.5, 1e-9); // a part of the force, not of the maximum
    for (int i = 0; i < 100; ++i)
        loop.tick(wrench_of(2), 0, 7); // clamped to 1
    EXPECT_EQ(loop.tick(wrench_of(2), 0, 7).force.y(), 2);
}
} // namespace
} // namespace ode_predictive_space::haptics
