// Memory: what is counted, and what counts as growth.

#include "tests/benchmarks/memory_measurement.h"

#include <cmath>
#include <gtest/gtest.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
using worlds::SpaceKind;

TEST(MemoryMeasurement, ThePredictiveSpaceCountsItsBytesAndChurnDoesNotAddToThem)
{
    const worlds::OdeSession ode;
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
    const worlds::OdeSession ode;
    const MemoryResult result = measure_memory(SpaceKind::simple, {"gas", 100, 1}, 10, 1);
    EXPECT_EQ(result.samples.back().counted, 0);
    EXPECT_TRUE(memory_record(result)["bytes_per_geom"].is_null());
}

TEST(MemoryMeasurement, OfShapesIsOfTheSameScene)
{
    const worlds::OdeSession ode;
    const worlds::WorldSpec spec{"terrain", 60, 1};
    const MemoryResult by_boxes = measure_memory(SpaceKind::predictive, spec, 60, 1);
    const MemoryResult by_shapes = measure_memory(SpaceKind::predictive_by_shapes, spec, 60, 1);
    EXPECT_EQ(by_boxes.samples.back().postponed, 0);
    EXPECT_GT(by_shapes.samples.back().postponed, 0);
    EXPECT_GT(by_shapes.samples.back().near, by_shapes.samples.back().postponed);
    EXPECT_GT(by_shapes.samples.back().counted, by_boxes.samples.back().counted);
    EXPECT_EQ(memory_record(by_shapes)["postponed"], by_shapes.samples.back().postponed);
}

MemoryResult result_of(std::int64_t counted, std::int64_t near)
{
    return {SpaceKind::predictive_by_shapes, {}, {{1, counted, 0, 0, 0, near}}};
}

TEST(MemoryMeasurement, ANearPairTakesWhatTwoScenesDifferBy)
{
    const ShapeMemory few{result_of(1000, 0), result_of(1400, 2)};
    const ShapeMemory many{result_of(5000, 0), result_of(5900, 12)};
    EXPECT_DOUBLE_EQ(bytes_per_near_pair(few, many), (900 - 400) / 10.0);
    EXPECT_TRUE(std::isnan(bytes_per_near_pair(few, few)));
}

TEST(MemoryMeasurement, GrowthIsTheSecondHalfOverTheFirst)
{
    MemoryResult result{SpaceKind::predictive, {}, {}};
    for (int i = 0; i < 20; ++i)
    {
        // The first two, a tenth, do not count.
        const std::int64_t bytes = i < 2 ? 5000 : 100 + 10 * i;
        result.samples.push_back({i + 1, bytes, 0, 0, 0, 0});
    }
    EXPECT_DOUBLE_EQ(memory_growth(result, &MemorySample::counted), 290.0 / 190.0);
    EXPECT_EQ(memory_growth(result, &MemorySample::allocated), 1) << "nothing does not grow";
}

} // namespace
} // namespace ode_predictive_space::benchmarks
