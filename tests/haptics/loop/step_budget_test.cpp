#include "ode_predictive_space/haptics/loop/loop_parts.h"

#include "ode_predictive_space/haptics/loop.h"
#include "tests/haptics/forecast/coupling_scene.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/scripted_device.h"

#include <cmath>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
class StepBudgetTest : public testing::Test
{
protected:
    static constexpr double period = 0.01; // s
    StepBudget budget_;
};

TEST_F(StepBudgetTest, OneStepIsAlwaysAfforded)
{
    for (const double took : {0.006, 0.01, 10.0})
    {
        budget_.note(took);
        EXPECT_EQ(budget_.affordable(period), 1);
    }
}

TEST_F(StepBudgetTest, ALongStepIsForgottenSlowly)
{
    budget_.note(0.004);
    budget_.note(0.0005);
    EXPECT_EQ(budget_.affordable(period), 1) << "one short step does not make up for it";
    int before = 1;
    for (int i = 0; i < 100; ++i)
    {
        budget_.note(0.0005);
        EXPECT_GE(budget_.affordable(period), before);
        before = budget_.affordable(period);
    }
    EXPECT_EQ(before, 10);
    budget_.note(0.004);
    EXPECT_EQ(budget_.affordable(period), 1) << "a long one counts at once";
}

/// The largest number of steps per period of a scene at 60 Hz, if a step takes this part of the period.
/// @param servo_rate Hz.
int steps_per_period(const CouplingCase &scenario, double part, double servo_rate = 1000)
{
    constexpr double rate = 60;
    const OdeUse ode;
    CouplingScene scene(Stepper::exact);
    scenario.build(scene);
    SimulatedClock clock;
    NoticeList notices;
    ScriptedDevice device([&](double seconds) { return scenario.hand.at(seconds); });
    device.open();
    HapticProbe probe(device, scene.space, radius, with_law(scenario.law()));
    LoopSettings settings = simulated(clock, 1, true, rate);
    settings.rate = servo_rate;
    settings.notice = notices.sink();
    HapticLoop loop(probe, settings);
    double shortest = 1 / rate;
    loop.run({[&] { scene.collide(probe); },
              [&](double step) {
                  shortest = std::min(shortest, step);
                  scene.step(step);
                  clock.advance(part / rate);
              }});
    if (part == 0)
    {
        EXPECT_NEAR(clock.now(), 1, 0.01) << "it lasts as long with shorter steps";
    }
    return static_cast<int>(std::lround(1 / (rate * shortest)));
}

TEST(StepsPerPeriod, ContactsAreSteppedAsOftenAsThereIsTimeFor)
{
    EXPECT_GE(steps_per_period(stack(5), 0), 6);
    EXPECT_EQ(steps_per_period(stack(5), 0, 180), 3) << "a step is not shorter than a tick";
    EXPECT_EQ(steps_per_period(stack(5), 0.12), 4);
    EXPECT_EQ(steps_per_period(stack(5), 0.2), 2);
    EXPECT_EQ(steps_per_period(stack(5), 0.3), 1);
    EXPECT_EQ(steps_per_period(stack(5), 0.8), 1);
}

TEST(StepsPerPeriod, WhatIsUnstableOtherwiseIsSteppedAsOftenAsItHasToBe)
{
    EXPECT_GT(steps_per_period(rope_of_twenty(), 0), 1);
    EXPECT_GT(steps_per_period(rope_of_twenty(), 0.3), 1);
}
} // namespace
} // namespace ode_predictive_space::haptics
