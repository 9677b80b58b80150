// The gap to the triangles of a mesh is never above the distance to any of them, also within the mesh's hull.

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/shape/surface_gap.h"
#include "tests/shape/random_shapes.h"
#include "tests/support/effort.h"

namespace ode_predictive_space
{
namespace
{
constexpr std::size_t all_at_once = 1000000;

class Ground
{
public:
    Ground(ShapeMaker &maker, int side)
    {
        const Vector3 size = Vector3(maker.between(0.1, 2), maker.between(0.1, 2), maker.between(0.1, 2));
        const bool is_bowl = maker.one_in(2);
        for (int i = 0; i <= side; ++i)
            for (int j = 0; j <= side; ++j)
            {
                const double x = 2.0 * i / side - 1, y = 2.0 * j / side - 1;
                points_.push_back(size.cwiseProduct(Vector3(x, y, is_bowl ? x * x + y * y : maker.between(0, 0.3))));
            }
        const auto number = [side](int i, int j) { return static_cast<std::uint32_t>(i * (side + 1) + j); };
        for (int i = 0; i < side; ++i)
            for (int j = 0; j < side; ++j)
                for (const auto &triangle : {std::array{number(i, j), number(i + 1, j), number(i, j + 1)},
                                             std::array{number(i + 1, j + 1), number(i + 1, j), number(i, j + 1)}})
                    triangles_.push_back(triangle);
    }

    ConvexShape shape() const
    {
        const auto tree = std::make_shared<TriangleTree>(arrays());
        tree->build(all_at_once);
        return hull_of(points_, tree);
    }

    std::size_t count() const { return triangles_.size(); }
    TriangleCorners corners(std::size_t i) const { return arrays().corners(static_cast<std::uint32_t>(i)); }
    Vector3 any_place(ShapeMaker &maker) const
    {
        const TriangleCorners at =
            corners(static_cast<std::size_t>(maker.between(0, 0.999) * static_cast<double>(count())));
        const double a = maker.between(0, 1), b = maker.between(0, 1 - a);
        return at[0] + a * (at[1] - at[0]) + b * (at[2] - at[0]);
    }

private:
    TriangleArrays arrays() const
    {
        return {points_.data(),
                sizeof(Vector3),
                static_cast<unsigned>(points_.size()),
                triangles_.data(),
                static_cast<unsigned>(triangles_.size()),
                sizeof(TriangleArrays::Indices),
                false};
    }

    std::vector<Vector3> points_;
    std::vector<TriangleArrays::Indices> triangles_;
};

double distance_from_above(const ConvexShape &shape, const Ground &surface, const Eigen::Matrix3d &turn,
                           const Vector3 &by)
{
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < surface.count(); ++i)
    {
        const TriangleCorners at = surface.corners(i);
        ConvexShape triangle = hull_of({turn * at[0] + by, turn * at[1] + by, turn * at[2] + by});
        distance = std::min(distance, distance_from_above(shape, triangle, 40));
    }
    return distance;
}

TEST(SurfaceGap, IsNeverMoreThanTheDistance)
{
    long gaps = 0, close = 0;
    for (unsigned seed = 0; seed < of_cases(1500); ++seed)
    {
        ShapeMaker maker(seed);
        const Ground surface(maker, 1 + static_cast<int>(seed % 6));
        const Eigen::Matrix3d turn = maker.rotation();
        const Vector3 by = maker.one_in(3) ? Vector3(100 * maker.vector()) : maker.vector();
        ConvexShape mesh = surface.shape();
        mesh.centre = turn * mesh.centre;
        mesh = moved(mesh, Eigen::Matrix3d::Identity(), by);
        for (Vector3 &axis : mesh.axes)
            axis = turn * axis;
        for (const SolidKind solid :
             {SolidKind::sphere, SolidKind::box, SolidKind::capsule, SolidKind::cylinder, SolidKind::hull})
        {
            const Vector3 place = turn * surface.any_place(maker) + by + maker.between(0, 0.8) * maker.direction();
            const ConvexShape shape = moved(maker.shape(solid), maker.rotation(), place);
            const double gap = surface_gap(mesh, shape, 1e-3).length,
                         distance = distance_from_above(shape, surface, turn, by);
            EXPECT_EQ(gap, surface_gap(shape, mesh, 1e-3).length) << "in the other order";
            ASSERT_LE(gap, std::max(distance, 1e-3)) << "seed " << seed;
            if (distance < 0.01)
                continue;
            ++gaps;
            close += gap >= 0.5 * std::min(distance, 4 * shape.size);
        }
    }
    EXPECT_GT(close, gaps * 9 / 10) << "of " << gaps;
}

} // namespace
} // namespace ode_predictive_space
