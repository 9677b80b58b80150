#include "tests/benchmarks/ridge_measurement.h"

#include "demos/runs/spaces.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
TEST(RidgeMeasurement, TheForceIsRightBetweenStepsOnMeshesOfAnySize)
{
    const worlds::OdeSession ode;
    for (const int cells : {22, 224})
    {
        haptics::SimulatedClock clock;
        RidgeSettings settings;
        settings.cells = cells;
        settings.seconds = 1;
        settings.clock = &clock;
        const RidgeResult result = run_ridges(settings);
        EXPECT_NEAR(static_cast<double>(result.report.ticks), 4000, 42);
        EXPECT_EQ(result.report.steps, 100u);
        EXPECT_GT(result.compared, 2500u);
        EXPECT_GT(result.worst_error, 0) << "it was compared with something else";
        EXPECT_LE(result.worst_error, 0.01) << settings.triangles();
    }
}
} // namespace
} // namespace ode_predictive_space::benchmarks
