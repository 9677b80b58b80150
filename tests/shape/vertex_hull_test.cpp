// The hull of points reaches as far as its farthest point.

#include "ode_predictive_space/broadphase/shape/vertex_hull.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "tests/shape/random_shapes.h"

namespace ode_predictive_space
{
namespace
{
std::vector<Vector3> random_points(ShapeMaker &maker, int count)
{
    std::vector<Vector3> points;
    for (int i = 0; i < count; ++i)
        points.push_back(maker.vector() + Vector3(3, 0, -5));
    return points;
}

TEST(VertexHull, ReachesAsFarAsItsFarthestPoint)
{
    ShapeMaker maker(1);
    for (int count : {1, 2, 7, 8, 9, 16, 17, 42, 100, 162, 1000, 3000})
    {
        const std::vector<Vector3> points = random_points(maker, count);
        const VertexHull hull(points);
        for (int i = 0; i < 2000; ++i)
        {
            const Vector3 direction = maker.between(0.1, 3) * maker.direction();
            double farthest = -std::numeric_limits<double>::infinity();
            for (const Vector3 &point : points)
                farthest = std::max(farthest, direction.dot(point - hull.centre()));
            ASSERT_NEAR(hull.reach(direction), farthest, 1e-13) << count << " points";
            ASSERT_NEAR(direction.dot(hull.farthest(direction)), farthest, 1e-13) << count << " points";
        }
    }
}

} // namespace
} // namespace ode_predictive_space
