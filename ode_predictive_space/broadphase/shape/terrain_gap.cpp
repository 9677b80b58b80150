#include "ode_predictive_space/broadphase/shape/terrain_gap.h"

#include <algorithm>
#include <limits>

#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/surface/height_grid.h"

namespace ode_predictive_space
{
namespace
{
using Box = Eigen::AlignedBox3d;

constexpr double most_periods = 4; // maximum search extent in a repeating terrain

class SeenFromTerrain
{
public:
    SeenFromTerrain(const ConvexShape &shape, const ConvexShape &terrain, const HeightGrid &grid)
        : shape_(shape), terrain_(terrain), grid_(grid),
          centre_(terrain.along_axes(shape.centre - terrain.centre) + 0.5 * Vector3(grid.width(), 0, grid.depth()))
    {
        for (std::size_t i = 0; i < 3; ++i)
            half_box_[static_cast<Eigen::Index>(i)] = half_box_along(terrain.axes[i]);
    }

    Box box() const { return Box(centre_ - half_box_, centre_ + half_box_); }

    // The gap between the shape and the solid column below a cell. ODE finds contacts of spheres, boxes and capsules that are
    // in the column of a triangle and below its plane, or whose box is below all corners of all cells beside it. ODE finds
    // contacts of other shapes if their box is below the highest corner of a cell. At the edge of the terrain, the plane of a
    // flat part extends beyond it; beside a steep corner, a box below all ground may be outside all planes.
    double gap_to(const HeightGrid::Cell &cell) const
    {
        if (shape_.kind != ShapeKind::rounded)
            return cell.distance;
        const int column = cell.column, row = cell.row;
        const double a = grid_.height(column, row), b = grid_.height(column + 1, row),
                     c = grid_.height(column, row + 1), d = grid_.height(column + 1, row + 1);
        const Vector3 at_b(cell.x + grid_.size().cell_x, b, cell.z);
        const double low = gap_to_plane(at_b, b - a, c - a);
        const double high = gap_to_plane(at_b, d - c, d - b);
        const double until_below = centre_.y() + half_box_.y() - std::min({a, b, c, d});
        return std::max(cell.distance, std::min({low, high, until_below}));
    }

private:
    // Half the side of the bounding box that ODE gives the shape in this frame. A cylinder's box changes when it turns about
    // its axis, which is no travel, so the largest possible side is used.
    double half_box_along(const Vector3 &axis) const
    {
        if (shape_.kind == ShapeKind::cylinder)
            return std::hypot(shape_.half_sides[2], shape_.radius, shape_.radius);
        return shape_.radius + shape_.half_sides.dot(shape_.along_axes(axis).cwiseAbs());
    }

    // The gap above the plane through a point that rises by along_x and along_z per cell.
    double gap_to_plane(const Vector3 &point, double along_x, double along_z) const
    {
        const Vector3 up = Vector3(-along_x / grid_.size().cell_x, 1, -along_z / grid_.size().cell_z).normalized();
        return up.dot(centre_ - point) - shape_.reach(-terrain_.from_axes(up));
    }

    const ConvexShape &shape_, &terrain_;
    const HeightGrid &grid_;
    Vector3 centre_, half_box_;
};

bool repeats_too_often(const HeightGrid &grid, const Box &box, double most)
{
    const Vector3 sides = box.sizes() + Vector3::Constant(2 * most);
    return sides.x() > most_periods * grid.width() || sides.z() > most_periods * grid.depth();
}

// ODE numbers the cells of a repeating terrain by an int, from its first copy on; if that overflows, it reads wrong samples.
bool overflows_cell_numbers(const HeightGrid &grid, const Box &box)
{
    constexpr double most_cells = 1 << 30;
    const Vector3 farthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
    return !(farthest.x() < most_cells * grid.size().cell_x && farthest.z() < most_cells * grid.size().cell_z);
}

// Heights are rounded to single precision here, and maybe in ODE.
double rounding_of_heights(const HeightGrid &grid)
{
    constexpr double roundings = 16;
    return roundings * double{std::numeric_limits<float>::epsilon()} * grid.largest();
}
} // namespace

Gap terrain_gap(const ConvexShape &terrain, const ConvexShape &other, double least)
{
    const HeightGrid &grid = static_cast<const HeightGrid &>(*terrain.surface());
    const double radius = other.bounding_radius();
    double gap = tuning::surface_search * (radius + least);
    if (!grid.is_finite())
        return {};
    const SeenFromTerrain shape(other, terrain, grid);
    const Box box = shape.box();
    if (grid.size().repeats && (overflows_cell_numbers(grid, box) || repeats_too_often(grid, box, gap)))
        return {};
    float work = 1;
    grid.walk(box, gap, [&](const HeightGrid::Cell &cell) {
        ++work;
        gap = std::min(gap, shape.gap_to(cell));
        return gap > least;
    });
    const double lost = skew_of_distances * (std::abs(gap) + 2 * radius) + rounding(terrain) + rounding(other) +
                        rounding_of_heights(grid);
    return {gap - lost, Vector3::Zero(), work};
}
} // namespace ode_predictive_space
