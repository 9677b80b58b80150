// The cost of a grid of heights, and the heights that it takes. Tests of contacts with heightfields check the cells that it finds.

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "ode_predictive_space/surface/height_grid.h"

namespace ode_predictive_space
{
namespace
{
constexpr std::size_t all_at_once = 100000000;

TEST(HeightGrids, NearerSquaresComeFirst)
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> height(-1, 1);
    HeightGrid grid({33, 33, 1, 1, false}, [&](int, int) { return height(random); });
    grid.build(all_at_once);
    double distance = 100;
    int visits = 0;
    grid.walk(Eigen::AlignedBox3d(Vector3(3, 2, 3), Vector3(3.1, 3, 3.1)), distance, [&](const HeightGrid::Cell &cell) {
        distance = std::min(distance, cell.distance);
        ++visits;
        return true;
    });
    EXPECT_LT(visits, 100) << "of 1024 cells";
}

// A grid that repeats is compared with nine copies side by side.
TEST(HeightGrids, ThatRepeatContinueInTheNextCopies)
{
    constexpr int cells = 8;
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> height(-1, 1), place(0, cells);
    const auto nearest = [](const HeightGrid &grid, const Vector3 &low) {
        double distance = 3;
        grid.walk(Eigen::AlignedBox3d(low, low + Vector3::Constant(0.1)), distance, [&](const HeightGrid::Cell &cell) {
            distance = std::min(distance, cell.distance);
            return true;
        });
        return distance;
    };
    for (int i = 0; i < 1000; ++i)
    {
        std::array<std::array<double, cells>, cells> heights{};
        for (auto &column : heights)
            std::generate(column.begin(), column.end(), [&] { return height(random); });
        const auto sample = [&](int column, int row) { return heights[column % cells][row % cells]; };
        HeightGrid one({cells + 1, cells + 1, 1, 1, true}, sample),
            nine({3 * cells + 1, 3 * cells + 1, 1, 1, false}, sample);
        one.build(all_at_once);
        nine.build(all_at_once);
        const Vector3 low(place(random), 1.5 + 0.4 * height(random), place(random));
        ASSERT_NEAR(nearest(one, low), nearest(nine, low + Vector3(cells, 0, cells)), 1e-12) << low.transpose();
    }
}

// A program's function may be slow, so the cost of building is counted in samples.
TEST(HeightGrids, AreBuiltInSlices)
{
    int samples = 0;
    HeightGrid grid({65, 65, 1, 1, false}, [&](int, int) {
        ++samples;
        return 0.0;
    });
    EXPECT_EQ(samples, 0) << "nothing is read before";
    int slices = 0, most = 0;
    while (!grid.is_ready())
    {
        const int before = samples;
        grid.build(1000);
        most = std::max(most, samples - before);
        ++slices;
    }
    EXPECT_EQ(samples, 65 * 65);
    EXPECT_LE(most, 125);
    EXPECT_LE(slices, 65 * 65 / 125 + 10);
    EXPECT_EQ(grid.build(10), 10u) << "nothing is left to do";
}

TEST(HeightGrids, TellTheLargestHeightAboveOrBelowZero)
{
    for (double sign : {1.0, -1.0})
    {
        HeightGrid grid({3, 3, 1, 1, false}, [&](int column, int) { return sign * (5 - column); });
        grid.build(all_at_once);
        EXPECT_EQ(grid.largest(), 5);
    }
}

TEST(HeightGrids, TellHeightsThatAreNotFinite)
{
    for (double one : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity(), 1e300, 2.0})
    {
        HeightGrid grid({3, 3, 1, 1, false}, [&](int column, int row) { return column == 1 && row == 1 ? one : 1.0; });
        grid.build(all_at_once);
        EXPECT_EQ(grid.is_finite(), one == 2) << one;
    }
}
} // namespace
} // namespace ode_predictive_space
