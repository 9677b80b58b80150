// Random grids of heights: every cell that is near a box is found, also where the grid repeats.

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "ode_predictive_space/surface/height_grid.h"

namespace ode_predictive_space
{
namespace
{
using Box = Eigen::AlignedBox3d;
using Place =
    std::tuple<int, int>; // columns and rows of a cell from the first sample; outside of the grid where it repeats

class HeightGrids : public testing::Test
{
protected:
    static constexpr std::size_t all_at_once = 100000000;

    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    int any(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

    std::unique_ptr<HeightGrid> rough_grid(const GridSize &size)
    {
        const auto height = [this](int, int) { return between(-1, 1); };
        auto grid = std::make_unique<HeightGrid>(size, height);
        grid->build(all_at_once);
        EXPECT_TRUE(grid->is_ready());
        return grid;
    }

    GridSize any_size(bool repeats) { return {any(2, 40), any(2, 40), between(0.1, 1), between(0.1, 1), repeats}; }

    static int within(int number, int count) { return (number % count + count) % count; }

    static double highest(const HeightGrid &grid, const Place &place)
    {
        const auto [i, j] = place;
        const int column = within(i, grid.size().columns - 1), row = within(j, grid.size().rows - 1);
        return std::max({grid.height(column, row), grid.height(column + 1, row), grid.height(column, row + 1),
                         grid.height(column + 1, row + 1)});
    }

    static double distance(const HeightGrid &grid, const Place &place, const Box &box)
    {
        const auto [i, j] = place;
        const double x = i * grid.size().cell_x, z = j * grid.size().cell_z;
        return std::max({x - box.max().x(), box.min().x() - x - grid.size().cell_x, z - box.max().z(),
                         box.min().z() - z - grid.size().cell_z, box.min().y() - highest(grid, place)});
    }

    static std::set<Place> visited(const HeightGrid &grid, const Box &box, double most)
    {
        std::set<Place> found;
        grid.walk(box, most, [&](const HeightGrid::Cell &cell) {
            const Place place(static_cast<int>(std::lround(cell.x / grid.size().cell_x)),
                              static_cast<int>(std::lround(cell.z / grid.size().cell_z)));
            EXPECT_TRUE(found.insert(place).second) << "none is visited twice";
            EXPECT_EQ(within(std::get<0>(place), grid.size().columns - 1), cell.column);
            EXPECT_EQ(within(std::get<1>(place), grid.size().rows - 1), cell.row);
            EXPECT_NEAR(cell.distance, distance(grid, place, box), 1e-9);
            return true;
        });
        return found;
    }

    void expect_all_near_found(bool repeats)
    {
        for (int i = 0; i < 200; ++i)
        {
            const auto grid = rough_grid(any_size(repeats));
            const double margin = repeats ? 2 * grid->width() : 0.5;
            const Vector3 least(between(-margin, grid->width()), between(-1.5, 1.5), between(-margin, grid->depth()));
            const Box box(least, least + Vector3(between(0, 2), between(0, 2), between(0, 2)));
            const double most = between(-0.1, 0.7);
            const std::set<Place> found = visited(*grid, box, most);
            const int beyond = repeats ? 3 * 40 : 0;
            for (int column = -beyond; column < grid->size().columns - 1 + beyond; ++column)
                for (int row = -beyond; row < grid->size().rows - 1 + beyond; ++row)
                    ASSERT_TRUE(found.count({column, row}) == 1 || distance(*grid, {column, row}, box) >= most - 1e-9);
        }
    }

    std::mt19937_64 random_{1};
};

TEST_F(HeightGrids, FindAllCellsThatAreNear)
{
    expect_all_near_found(false);
}

TEST_F(HeightGrids, FindAllCellsThatAreNearWhereTheyRepeat)
{
    expect_all_near_found(true);
}

TEST_F(HeightGrids, NearerSquaresComeFirst)
{
    const auto grid = rough_grid({33, 33, 1, 1, false});
    double distance = 100;
    int visits = 0;
    grid->walk(Box(Vector3(3, 2, 3), Vector3(3.1, 3, 3.1)), distance, [&](const HeightGrid::Cell &cell) {
        distance = std::min(distance, cell.distance);
        ++visits;
        return true;
    });
    EXPECT_LT(visits, 100) << "of 1024 cells";
}

// A program's function may be slow, so the cost of building is counted in samples.
TEST_F(HeightGrids, AreBuiltInSlices)
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

TEST_F(HeightGrids, TellHeightsThatAreNotFinite)
{
    for (double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity(), 1e300})
    {
        HeightGrid grid({3, 3, 1, 1, false}, [&](int column, int row) { return column == 1 && row == 1 ? bad : 1.0; });
        grid.build(all_at_once);
        EXPECT_FALSE(grid.is_finite());
    }
    EXPECT_TRUE(rough_grid({3, 3, 1, 1, false})->is_finite());
}
} // namespace
} // namespace ode_predictive_space
