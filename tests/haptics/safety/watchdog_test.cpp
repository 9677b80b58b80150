#include "ode_predictive_space/haptics/safety/watchdog.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/random_numbers.h"

namespace ode_predictive_space::haptics
{
namespace
{
/// A servo loop of 1 kHz in which scene and device work until a test changes that.
struct Program
{
    explicit Program(const WatchdogLimits &limits = {}) : watchdog(limits) {}

    void tick(double elapsed = dt)
    {
        time += elapsed;
        if (physics_runs)
            watchdog.physics_fresh(time);
        watchdog.device_answered(device_answers);
        watchdog.servo_ticked(time);
        stale_ticks += watchdog.reason() == WatchdogReason::physics_stale ? 1 : 0;
    }

    void run(double seconds)
    {
        for (int i = 0; i < std::lround(seconds / dt); ++i)
            tick();
    }

    void settle()
    {
        run(1);
        ASSERT_EQ(watchdog.factor(), 1);
        ASSERT_EQ(watchdog.reason(), WatchdogReason::none);
    }

    Watchdog watchdog;
    double time = 5;
    bool physics_runs = true;
    bool device_answers = true;
    int stale_ticks = 0;
};

TEST(Watchdog, BeginsAtZeroAndRisesWhenAllIsWell)
{
    Program program;
    EXPECT_EQ(program.watchdog.factor(), 0);
    program.tick();
    EXPECT_EQ(program.watchdog.factor(), 0);
    double last = 0;
    for (int i = 1; i < 250; ++i)
    {
        program.tick();
        EXPECT_NEAR(program.watchdog.factor() - last, dt / 0.25, 1e-12);
        last = program.watchdog.factor();
    }
    program.run(0.003);
    EXPECT_EQ(program.watchdog.factor(), 1);
}

TEST(Watchdog, StaysAtZeroAsLongAsSomethingHasNotShownThatItLives)
{
    Program without_device;
    without_device.device_answers = false;
    without_device.run(0.5);
    EXPECT_EQ(without_device.watchdog.factor(), 0);
    EXPECT_EQ(without_device.watchdog.reason(), WatchdogReason::device_lost);
    Program without_physics;
    without_physics.physics_runs = false;
    without_physics.run(0.5);
    EXPECT_EQ(without_physics.watchdog.factor(), 0);
    EXPECT_EQ(without_physics.watchdog.reason(), WatchdogReason::physics_stale);
}

/// The elapsed time is unknown then.
TEST(Watchdog, AClockThatGoesBackTakesTheForceAtOnce)
{
    Program program;
    program.settle();
    program.tick(-3);
    EXPECT_EQ(program.watchdog.factor(), 0);
    EXPECT_EQ(program.watchdog.reason(), WatchdogReason::servo_late);
    program.tick();
    EXPECT_LT(program.watchdog.factor(), 0.01) << "it comes back slowly";
    program.settle();
}

TEST(Watchdog, WithoutPhysicsTheForceIsGoneWithinTenMilliseconds)
{
    WatchdogLimits limits;
    limits.stale_after = 0.0035; // between two ticks, so that rounding of times decides nothing
    Program program(limits);
    program.settle();
    program.physics_runs = false;
    program.run(0.003);
    EXPECT_EQ(program.watchdog.factor(), 1); // not yet: a step may take so long
    double last = 1.1;                       // the fault begins half a tick before the next one
    for (int i = 0; i < 5; ++i)
    {
        program.tick();
        EXPECT_NEAR(program.watchdog.factor(), last - 0.2, 1e-9);
        EXPECT_EQ(program.watchdog.reason(), WatchdogReason::physics_stale);
        last = program.watchdog.factor();
    }
    program.tick();
    EXPECT_EQ(program.watchdog.factor(), 0); // 9 ms after the last step

    program.physics_runs = true;
    program.tick();
    EXPECT_EQ(program.watchdog.reason(), WatchdogReason::none);
    EXPECT_NEAR(program.watchdog.factor(), dt / 0.25, 1e-12);
    program.run(0.3);
    EXPECT_EQ(program.watchdog.factor(), 1);
    EXPECT_EQ(program.stale_ticks, 6);
}

TEST(Watchdog, TheServoIsLateByItsOwnRate)
{
    EXPECT_EQ(WatchdogLimits::of(1000, 50).late_after, WatchdogLimits::of(1000, 1000).late_after);
    EXPECT_GT(WatchdogLimits::of(50, 1000).late_after, WatchdogLimits::of(1000, 1000).late_after);
    EXPECT_DOUBLE_EQ(WatchdogLimits::of(50, 1000).late_period, 0.03);
}

TEST(Watchdog, SlowerPhysicsIsGivenItsTime)
{
    Program program(WatchdogLimits::of(1000, 100));
    for (int i = 0; i < 1000; ++i)
    {
        program.physics_runs = i % 10 == 0;
        program.tick();
    }
    EXPECT_EQ(program.watchdog.factor(), 1);
    EXPECT_EQ(program.stale_ticks, 0);
    program.physics_runs = false;
    program.run(0.046); // four periods and the decay
    EXPECT_EQ(program.watchdog.factor(), 0);
}

TEST(Watchdog, ADeadlineMissedByLittleCostsLittleByMuchAll)
{
    Program program;
    program.settle();
    program.tick(0.0039);
    EXPECT_EQ(program.watchdog.factor(), 1);
    program.tick(0.005); // 1 ms beyond 4 ms
    EXPECT_EQ(program.watchdog.reason(), WatchdogReason::servo_late);
    EXPECT_NEAR(program.watchdog.factor(), 0.8, 1e-9);
    program.tick();
    EXPECT_EQ(program.watchdog.reason(), WatchdogReason::none);
    program.settle();
    program.tick(0.1);
    EXPECT_EQ(program.watchdog.factor(), 0);
    program.settle();
}

TEST(Watchdog, OfTwoFaultsTheLongerOneCounts)
{
    Program program;
    program.settle();
    program.physics_runs = false;
    program.watchdog.physics_fresh(program.time + 0.1 - 0.0045); // stale for half a millisecond
    program.tick(0.1);                                           // but the servo stood still for much longer
    EXPECT_EQ(program.watchdog.reason(), WatchdogReason::physics_stale);
    EXPECT_EQ(program.watchdog.factor(), 0);
}

TEST(Watchdog, ManyMissedDeadlinesInARowAreTooMany)
{
    Program program;
    program.settle();
    for (int i = 0; i < 19; ++i)
        program.tick(0.002);
    EXPECT_EQ(program.watchdog.factor(), 1);
    program.tick(); // in time: the count restarts
    for (int i = 0; i < 19; ++i)
        program.tick(0.002);
    EXPECT_EQ(program.watchdog.factor(), 1);
    for (int i = 0; i < 4; ++i)
    {
        program.tick(0.002);
        EXPECT_EQ(program.watchdog.reason(), WatchdogReason::servo_late);
    }
    EXPECT_EQ(program.watchdog.factor(), 0);
    program.settle();
}

TEST(Watchdog, TellsTheForemostOfSeveralReasons)
{
    Program program;
    program.settle();
    program.physics_runs = false;
    program.tick(1);
    EXPECT_EQ(program.watchdog.reason(), WatchdogReason::physics_stale);
    program.device_answers = false;
    program.tick(1);
    EXPECT_EQ(program.watchdog.reason(), WatchdogReason::device_lost);
}

TEST(Watchdog, ATimeThatIsNoNumberIsAFault)
{
    Program program;
    program.settle();
    program.watchdog.physics_fresh(std::numeric_limits<double>::quiet_NaN());
    program.watchdog.servo_ticked(program.time + dt);
    EXPECT_EQ(program.watchdog.reason(), WatchdogReason::physics_stale);
    EXPECT_EQ(program.watchdog.factor(), 0);
    program.settle();
    program.watchdog.servo_ticked(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(program.watchdog.factor(), 0);
    program.settle();
}

TEST(Watchdog, TheFactorIsAFractionFallsWithinItsTimeAndRisesSlowly)
{
    RandomNumbers random(1);
    for (int run = 0; run < 100; ++run)
    {
        Program program;
        double bad_since = program.time;
        for (int tick = 0; tick < 2000; ++tick)
        {
            if (random.one_in(100))
                program.physics_runs = !program.physics_runs;
            if (random.one_in(200))
                program.device_answers = !program.device_answers;
            const double elapsed = random.one_in(50) ? random.between(0, 0.02) : random.between(0.0005, 0.0014);
            const double before = program.watchdog.factor();
            program.tick(elapsed);
            const double factor = program.watchdog.factor();
            ASSERT_GE(factor, 0);
            ASSERT_LE(factor, 1);
            ASSERT_LE(factor, before + elapsed / 0.25 + 1e-12);
            if (program.watchdog.reason() == WatchdogReason::none)
                bad_since = program.time;
            const bool long_bad = program.time - bad_since > 0.01; // the fault began after the last good tick
            ASSERT_TRUE(!long_bad || factor < 1e-9);
        }
    }
}

TEST(Watchdog, RefusesRatesThatCannotBe)
{
    EXPECT_THROW(WatchdogLimits::of(0, 1), std::invalid_argument);
    EXPECT_THROW(WatchdogLimits::of(1, -1), std::invalid_argument);
}
} // namespace
} // namespace ode_predictive_space::haptics
