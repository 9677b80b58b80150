// Memory: what is counted, and what counts as growth.

#include "tests/benchmarks/memory_measurement.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
using scenes::SpaceKind;

TEST(MemoryMeasurement, ThePredictiveSpaceCountsItsBytesAndChurnDoesNotAddToThem)
{
    const scenes::OdeSession ode;
    const MemoryResult result = measure_memory(SpaceKind::predictive, {"churn", 200, 1}, 4000, 20);
    ASSERT_EQ(result.samples.size(), 20u);
    EXPECT_EQ(result.samples.front().tick, 200);
    EXPECT_EQ(result.samples.back().tick, 4000);
    EXPECT_GT(result.samples.back().counted, 200 * 64);
    EXPECT_LT(memory_growth(result, &MemorySample::counted), 1.2);
    const nlohmann::json record = memory_record(result);
    EXPECT_DOUBLE_EQ(record["bytes_per_geom"].get<double>(), result.samples.back().counted / 200.0);
    EXPECT_EQ(record["samples"].size(), 20u);
}

TEST(MemoryMeasurement, ASpaceThatDoesNotCountHasNoBytesPerGeom)
{
    const scenes::OdeSession ode;
    const MemoryResult result = measure_memory(SpaceKind::simple, {"gas", 100, 1}, 10, 1);
    EXPECT_EQ(result.samples.back().counted, 0);
    EXPECT_TRUE(memory_record(result)["bytes_per_geom"].is_null());
}

TEST(MemoryMeasurement, GrowthIsTheSecondHalfOverTheFirst)
{
    MemoryResult result{SpaceKind::predictive, {}, {}};
    for (int i = 0; i < 20; ++i)
    {
        // The first two, a tenth, do not count.
        const std::int64_t bytes = i < 2 ? 5000 : 100 + 10 * i;
        result.samples.push_back({i + 1, bytes, 0, 0});
    }
    EXPECT_DOUBLE_EQ(memory_growth(result, &MemorySample::counted), 290.0 / 190.0);
    EXPECT_EQ(memory_growth(result, &MemorySample::allocated), 1) << "nothing does not grow";
}

} // namespace
} // namespace ode_predictive_space::benchmarks
