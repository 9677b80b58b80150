#include "ode_predictive_space/surface/height_grid.h"

#include <limits>
#include <utility>

namespace ode_predictive_space
{
namespace
{
// Reading a sample may call a slow function of the program.
constexpr std::size_t steps_per_sample = 8;
} // namespace

HeightGrid::HeightGrid(const GridSize &size, Height height) : size_(size), height_(std::move(height)) {}

std::size_t HeightGrid::build(std::size_t steps)
{
    if (!height_)
        return steps;
    steps = read(steps);
    while (steps > 0 && height_)
    {
        if (levels_.empty() || levels_.back().highest.size() == static_cast<std::size_t>(levels_.back().columns) *
                                                                    static_cast<std::size_t>(levels_.back().rows))
        {
            begin_level();
            continue;
        }
        Level &level = levels_.back();
        const int place = static_cast<int>(level.highest.size());
        level.highest.push_back(highest_below(place % level.columns, place / level.columns));
        --steps;
    }
    return steps;
}

// Reads samples. @return the unused steps once all samples are read, otherwise 0.
std::size_t HeightGrid::read(std::size_t steps)
{
    const std::size_t all = index(0, size_.rows);
    samples_.reserve(all);
    for (; samples_.size() < all; steps -= steps_per_sample)
    {
        if (steps < steps_per_sample)
            return 0;
        const int place = static_cast<int>(samples_.size());
        int column = place % size_.columns, row = place / size_.columns;
        if (size_.repeats)
        {
            column %= size_.columns - 1;
            row %= size_.rows - 1;
        }
        const double height = height_(column, row);
        samples_.push_back(static_cast<float>(height));
        largest_ = std::abs(height) <= std::numeric_limits<float>::max() ? std::max(largest_, std::abs(height))
                                                                         : std::numeric_limits<double>::infinity();
    }
    return steps;
}

// The grid is ready when the last level is one square.
void HeightGrid::begin_level()
{
    Level level;
    if (levels_.empty())
    {
        level.columns = size_.columns - 1;
        level.rows = size_.rows - 1;
    }
    else
    {
        const Level &below = levels_.back();
        if (below.highest.size() == 1)
        {
            height_ = nullptr;
            return;
        }
        level.columns = (below.columns + 1) / 2;
        level.rows = (below.rows + 1) / 2;
    }
    level.highest.reserve(static_cast<std::size_t>(level.columns) * static_cast<std::size_t>(level.rows));
    levels_.push_back(std::move(level));
}

// The square is one of the level under construction.
float HeightGrid::highest_below(int column, int row) const
{
    if (levels_.size() == 1)
        return std::max({samples_[index(column, row)], samples_[index(column + 1, row)],
                         samples_[index(column, row + 1)], samples_[index(column + 1, row + 1)]});
    const Level &below = levels_[levels_.size() - 2];
    float highest = -std::numeric_limits<float>::infinity();
    for (int j = 2 * row; j < std::min(2 * row + 2, below.rows); ++j)
        for (int i = 2 * column; i < std::min(2 * column + 2, below.columns); ++i)
            highest = std::max(highest, below.at(i, j));
    return highest;
}

double HeightGrid::distance_to(const Eigen::AlignedBox3d &box, const Square &square) const
{
    const Level &level = levels_[static_cast<std::size_t>(square.level)];
    const int first_column = square.column << square.level, first_row = square.row << square.level;
    const int end_column = std::min((square.column + 1) << square.level, size_.columns - 1),
              end_row = std::min((square.row + 1) << square.level, size_.rows - 1);
    return std::max({box.min().y() - double{level.at(square.column, square.row)},
                     first_column * size_.cell_x - box.max().x(), box.min().x() - end_column * size_.cell_x,
                     first_row * size_.cell_z - box.max().z(), box.min().z() - end_row * size_.cell_z});
}

std::size_t HeightGrid::bytes() const
{
    std::size_t sum = sizeof *this + samples_.capacity() * sizeof samples_[0];
    for (const Level &level : levels_)
        sum += sizeof level + level.highest.capacity() * sizeof level.highest[0];
    return sum;
}
} // namespace ode_predictive_space
