// The heights of a heightfield in a pyramid of maxima. In: a box and a distance. Out: the cells that may be that near.

#ifndef ODE_PREDICTIVE_SPACE_SURFACE_HEIGHT_GRID_H
#define ODE_PREDICTIVE_SPACE_SURFACE_HEIGHT_GRID_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "ode_predictive_space/prediction/path.h"
#include "ode_predictive_space/surface/surface.h"

namespace ode_predictive_space
{
/// A grid of samples along x and z. Four neighbours are the corners of a cell; y is up.
struct GridSize
{
    int columns = 2, rows = 2;     ///< numbers of samples along x and z
    double cell_x = 1, cell_z = 1; ///< sides of a cell
    bool repeats = false;          ///< the grid is infinite; its last column and row equal the first ones
};

/// A cell is two triangles; everything below them is solid, as in ODE. Lengths and points are in the grid's frame, with the
/// first sample at x = z = 0. The grid takes about 5 bytes per triangle, as heights are rounded to single precision.
class HeightGrid final : public Surface
{
public:
    using Height = std::function<double(int, int)>; ///< height of a sample by column and row

    struct Cell
    {
        int column, row; ///< those of the corner with the least x and z
        double x, z;     ///< coordinates of that corner, in the cell's copy if the grid repeats
        double distance; ///< largest gap along an axis between a box and the solid below; negative if they overlap
    };

    /// @param height is called only by build(), until the grid is ready.
    HeightGrid(const GridSize &size, Height height);

    std::size_t count() const override { return 2 * cells(); }
    std::size_t build(std::size_t steps) override;
    bool is_ready() const override { return !height_; }
    std::size_t bytes() const override;

    const GridSize &size() const { return size_; }
    double width() const { return (size_.columns - 1) * size_.cell_x; }
    double depth() const { return (size_.rows - 1) * size_.cell_z; }

    /// Are all heights finite in single precision? @pre of this and largest(): the grid is ready.
    bool is_finite() const { return std::isfinite(largest_); }
    double largest() const { return largest_; }
    double height(int column, int row) const { return samples_[index(column, row)]; }

    /// Calls visit(const Cell &) for each cell whose Cell::distance is less than `distance`, until visit returns false. Visits
    /// may reduce `distance`. @pre the grid is ready and finite.
    template <typename Visit> void walk(const Eigen::AlignedBox3d &box, const double &distance, Visit visit) const;

private:
    // Maxima of the cells, or of squares of four places of the level below.
    struct Level
    {
        int columns = 0, rows = 0;
        std::vector<float> highest;

        float at(int column, int row) const
        {
            return highest[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                           static_cast<std::size_t>(column)];
        }
    };

    struct Square
    {
        int level, column, row;
        double distance;
    };

    static constexpr std::size_t most_waiting = 128; // three per level, and four more

    std::size_t cells() const
    {
        return static_cast<std::size_t>(size_.columns - 1) * static_cast<std::size_t>(size_.rows - 1);
    }
    std::size_t index(int column, int row) const
    {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.columns) +
               static_cast<std::size_t>(column);
    }

    std::size_t read(std::size_t steps);
    void begin_level();
    float highest_below(int column, int row) const;
    double distance_to(const Eigen::AlignedBox3d &box, const Square &square) const;
    template <typename Visit>
    bool walk_copy(const Eigen::AlignedBox3d &box, const Vector3 &place, const double &distance, Visit visit) const;

    GridSize size_;
    Height height_; // empty once the grid is ready
    double largest_ = 0;
    std::vector<float> samples_;
    std::vector<Level> levels_;
};

template <typename Visit>
void HeightGrid::walk(const Eigen::AlignedBox3d &box, const double &distance, Visit visit) const
{
    int first_x = 0, last_x = 0, first_z = 0, last_z = 0;
    if (size_.repeats)
    {
        first_x = static_cast<int>(std::floor((box.min().x() - distance) / width()));
        last_x = static_cast<int>(std::floor((box.max().x() + distance) / width()));
        first_z = static_cast<int>(std::floor((box.min().z() - distance) / depth()));
        last_z = static_cast<int>(std::floor((box.max().z() + distance) / depth()));
    }
    for (int i = first_x; i <= last_x; ++i)
        for (int j = first_z; j <= last_z; ++j)
            if (!walk_copy(box, Vector3(i * width(), 0, j * depth()), distance, visit))
                return;
}

// @param place the position of this copy's first sample.
template <typename Visit>
bool HeightGrid::walk_copy(const Eigen::AlignedBox3d &box, const Vector3 &place, const double &distance,
                           Visit visit) const
{
    const Eigen::AlignedBox3d seen(box.min() - place, box.max() - place);
    std::array<Square, most_waiting> waiting;
    std::size_t count = 0;
    const auto wait = [&](int level, int column, int row) {
        Square square{level, column, row, 0};
        square.distance = distance_to(seen, square);
        waiting[count++] = square;
    };
    wait(static_cast<int>(levels_.size()) - 1, 0, 0);
    while (count > 0)
    {
        const Square next = waiting[--count];
        if (!(next.distance < distance))
            continue;
        if (next.level == 0)
        {
            if (!visit(Cell{next.column, next.row, place.x() + next.column * size_.cell_x,
                            place.z() + next.row * size_.cell_z, next.distance}))
                return false;
            continue;
        }
        const std::size_t first = count;
        const Level &below = levels_[static_cast<std::size_t>(next.level - 1)];
        for (int row = 2 * next.row; row < std::min(2 * next.row + 2, below.rows); ++row)
            for (int column = 2 * next.column; column < std::min(2 * next.column + 2, below.columns); ++column)
                wait(next.level - 1, column, row);
        std::sort(waiting.begin() + static_cast<std::ptrdiff_t>(first),
                  waiting.begin() + static_cast<std::ptrdiff_t>(count),
                  [](const Square &one, const Square &other) { return one.distance > other.distance; });
    }
    return true;
}
} // namespace ode_predictive_space

#endif
