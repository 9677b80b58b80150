#include "ode_predictive_space/broadphase/shape/surface_gap.h"

#include <algorithm>
#include <limits>

#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/prediction/envelope.h"
#include "ode_predictive_space/surface/height_grid.h"
#include "ode_predictive_space/surface/triangle_tree.h"

namespace ode_predictive_space
{
namespace
{
class SeenFromMesh
{
public:
    SeenFromMesh(const ConvexShape &shape, const ConvexShape &mesh)
        : shape_(shape), mesh_(mesh), centre_(place_in(mesh, shape.centre)), radius_(shape.bounding_radius())
    {}

    const Vector3 &centre() const { return centre_; }
    double radius() const { return radius_; }

    // Lower bound of the distance between a triangle and the centre.
    double distance_to(const TriangleCorners &corners) const
    {
        const Vector3 direction = direction_from(corners);
        const double length = direction.norm();
        return length > 0 ? (direction.dot(centre_) - farthest(direction, corners)) / length : 0;
    }

    // Work of gap_to() for its five axes.
    float work_of_gap() const { return 5 * shape_.work_of_reach(); }

    // The largest gap to a triangle along a few axes: from its nearest point to the centre, its normal, and the axes of a box.
    double gap_to(const TriangleCorners &corners) const
    {
        const Vector3 direction = direction_from(corners);
        const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        double largest = std::max(gap_along(direction, corners), gap_along(towards(direction, normal), corners));
        for (std::size_t i = 0; i < 3; ++i)
            if (shape_.half_sides[static_cast<Eigen::Index>(i)] > 0)
                largest = std::max(largest, gap_along(towards(direction, mesh_.along_axes(shape_.axes[i])), corners));
        return largest;
    }

private:
    // The second step corrects for a matrix that is not exactly a rotation.
    static Vector3 place_in(const ConvexShape &mesh, const Vector3 &point)
    {
        const Vector3 from_centre = point - mesh.centre;
        const Vector3 nearly = mesh.along_axes(from_centre);
        return nearly + mesh.along_axes(from_centre - mesh.from_axes(nearly)) + mesh.hull->centre();
    }

    Vector3 direction_from(const TriangleCorners &corners) const
    {
        return centre_ - nearest_on_triangle(centre_, corners).point;
    }

    static Vector3 towards(const Vector3 &direction, const Vector3 &axis)
    {
        return axis.dot(direction) < 0 ? Vector3(-axis) : axis;
    }

    static double farthest(const Vector3 &direction, const TriangleCorners &corners)
    {
        return std::max({direction.dot(corners[0]), direction.dot(corners[1]), direction.dot(corners[2])});
    }

    double gap_along(const Vector3 &direction, const TriangleCorners &corners) const
    {
        const double length = direction.norm();
        if (!(length > 0))
            return -radius_;
        const Vector3 axis = direction / length;
        return axis.dot(centre_) - farthest(axis, corners) - shape_.reach(-mesh_.from_axes(axis));
    }

    const ConvexShape &shape_, &mesh_;
    Vector3 centre_;
    double radius_;
};

// Lower bound of the distance between the surface and the shape's centre, at most `most`. The search ignores triangles that are
// only a little nearer than the nearest one found.
double distance_of(const TriangleTree &tree, const SeenFromMesh &shape, double most, float &work)
{
    double distance = tuning::near_enough * most;
    tree.walk(shape.centre(), distance, [&](std::uint32_t triangle) {
        ++work;
        distance = std::min(distance, tuning::near_enough * shape.distance_to(tree.corners(triangle)));
        return true;
    });
    return distance;
}

// The gap between the surface and the shape, at most `most`.
double gap_of(const TriangleTree &tree, const SeenFromMesh &shape, double most, double least, float &work)
{
    double gap = most, reach = gap + shape.radius();
    tree.walk(shape.centre(), reach, [&](std::uint32_t triangle) {
        work += shape.work_of_gap();
        gap = std::min(gap, shape.gap_to(tree.corners(triangle)));
        reach = gap + shape.radius();
        return gap > least;
    });
    return gap;
}

Gap gap_to_triangles(const ConvexShape &mesh, const ConvexShape &other, double least)
{
    const TriangleTree &tree = static_cast<const TriangleTree &>(*mesh.surface());
    const SeenFromMesh shape(other, mesh);
    const double radius = shape.radius(), far = tuning::surface_search * (radius + least);
    float work = 1;
    double gap = distance_of(tree, shape, far, work) - radius;
    if (!(gap > radius + least))
        gap = gap_of(tree, shape, 2 * (radius + least), least, work);
    const double lost = skew_of_distances * (std::abs(gap) + 2 * radius) + rounding(mesh) + rounding(other);
    return {gap - lost, Vector3::Zero(), work};
}

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

// The gap to a terrain, solid to any depth. None if heights are not finite, or if the terrain repeats within a few sizes.
Gap gap_to_terrain(const ConvexShape &terrain, const ConvexShape &other, double least)
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

bool is_terrain(const ConvexShape &shape)
{
    return shape.kind == ShapeKind::terrain;
}

Gap gap_between(const ConvexShape &surface, const ConvexShape &other, double least)
{
    return is_terrain(surface) ? gap_to_terrain(surface, other, least) : gap_to_triangles(surface, other, least);
}
} // namespace

const ConvexShape *surface_of(const ConvexShape &first, const ConvexShape &second)
{
    if (!judged_by_shape(first, second) || first.kind == ShapeKind::half_space || second.kind == ShapeKind::half_space)
        return nullptr;
    if (is_terrain(first) || is_terrain(second))
        return is_terrain(first) ? &first : &second;
    const auto triangles = [](const ConvexShape &shape) { return shape.surface() ? shape.surface()->count() : 0; };
    const ConvexShape &surface = triangles(first) < triangles(second) ? second : first;
    return surface.surface() ? &surface : nullptr;
}

Gap surface_gap(const ConvexShape &first, const ConvexShape &second, double least)
{
    const ConvexShape *surface = surface_of(first, second);
    if (!surface)
        return {};
    const ConvexShape &other = surface == &first ? second : first;
    return other.blunt_beside & surface->group ? gap_between(*surface, other.blunt(), least)
                                               : gap_between(*surface, other, least);
}
} // namespace ode_predictive_space
