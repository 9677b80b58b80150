#include "ode_predictive_space/broadphase/shape/surface_gap.h"

#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/shape/terrain_gap.h"
#include "ode_predictive_space/broadphase/tuning.h"
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

Gap gap_between(const ConvexShape &surface, const ConvexShape &other, double least)
{
    return surface.kind == ShapeKind::terrain ? terrain_gap(surface, other, least)
                                              : gap_to_triangles(surface, other, least);
}

bool is_terrain(const ConvexShape &shape)
{
    return shape.kind == ShapeKind::terrain;
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
