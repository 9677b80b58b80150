#include "tests/benchmarks/servo_measurement.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
using worlds::SpaceKind;

ServoResult run_simulated(SpaceKind kind, bool decoupled)
{
    haptics::SimulatedClock clock;
    ServoSettings settings;
    settings.objects = 300;
    settings.decoupled = decoupled;
    settings.rate = decoupled ? 4000 : 1000;
    settings.seconds = 2;
    settings.clock = &clock;
    return run_servo(kind, settings);
}

TEST(ServoMeasurement, IsTheSameInEverySpace)
{
    const worlds::OdeSession ode;
    const ServoResult ours = run_simulated(SpaceKind::predictive, false);
    for (const SpaceKind kind : {SpaceKind::simple, SpaceKind::hash, SpaceKind::quadtree})
    {
        const ServoResult other = run_simulated(kind, false);
        EXPECT_EQ(other.pairs, ours.pairs) << space_name(kind);
        EXPECT_EQ(other.steps_in_touch, ours.steps_in_touch) << space_name(kind);
    }
}

TEST(ServoMeasurement, RunsDecoupled)
{
    const worlds::OdeSession ode;
    const ServoResult result = run_simulated(SpaceKind::predictive, true);
    EXPECT_NEAR(static_cast<double>(result.report.ticks), 8000, 20);
    EXPECT_EQ(result.report.steps, 500u);
    EXPECT_GT(result.steps_in_touch, 2u);
}
} // namespace
} // namespace ode_predictive_space::benchmarks
