#include "ode_predictive_space/haptics/contact/closest_point.h"

#include <gtest/gtest.h>

#include "tests/haptics/support/random_numbers.h"

namespace ode_predictive_space::haptics
{
namespace
{
ConstraintPlane plane(const Vector3 &normal, double depth)
{
    ConstraintPlane result;
    result.normal = normal;
    result.depth = depth;
    result.share = -1; // to be overwritten
    return result;
}

double worst_violation(const std::vector<ConstraintPlane> &planes, const Vector3 &point)
{
    double worst = 0;
    for (const ConstraintPlane &plane : planes)
        worst = std::max(worst, plane.depth - plane.normal.dot(point));
    return worst;
}

TEST(ClosestPoint, IsFoundBetweenManyNearlyEqualPlanes)
{
    RandomNumbers random(3);
    for (const double spread : {0.1, 1e-3, 1e-5, 1e-7, 1e-12})
        for (int i = 0; i < 200; ++i)
        {
            const Vector3 up = random.direction();
            std::vector<ConstraintPlane> planes;
            for (int k = 0; k < 20; ++k)
                planes.push_back(
                    plane((up + random.in_cube(spread)).normalized(), 0.01 + random.between(0, spread * 0.01)));
            EXPECT_TRUE(find_closest_point(planes)) << spread;
            EXPECT_LE(worst_violation(planes, lift_of(planes)), 2e-9 * 0.02) << spread;
        }
}

TEST(ClosestPoint, IsFoundInACornerOfManyPlanesThroughOneEdge)
{
    RandomNumbers random(4);
    for (int i = 0; i < 200; ++i)
    {
        // All planes contain the line along y through this point, so their normals are coplanar.
        const Vector3 on_edge(0.001, 0, 0.004);
        std::vector<ConstraintPlane> planes;
        for (int k = 0; k < 12; ++k)
        {
            const double angle = random.between(-1, 1);
            const Vector3 normal(std::sin(angle), 0, std::cos(angle));
            planes.push_back(plane(normal, std::max(0.0, normal.dot(on_edge))));
        }
        EXPECT_TRUE(find_closest_point(planes));
        EXPECT_LE(worst_violation(planes, lift_of(planes)), 1e-11);
        EXPECT_LE(lift_of(planes).norm(), on_edge.norm() + 1e-12);
    }
}

// Two planes at an edge of a scanned mesh. The lift by either one leaves more than 1e-9 of the depth in the other, and the
// rounded normals do not determine their corner.
TEST(ClosestPoint, IsFoundWhereRoundingHidesTheCornerOfTwoPlanes)
{
    std::vector<ConstraintPlane> planes = {
        plane({3.6040162085170895e-05, 0, 0.99999999935055339}, 0.015333333329842769),
        plane({0, -3.2436145965682079e-05, 0.99999999947394824}, 0.015333333330505978)};
    EXPECT_TRUE(find_closest_point(planes));
    EXPECT_LE(worst_violation(planes, lift_of(planes)), 1e-6 * 0.0154);
    EXPECT_NEAR(lift_of(planes).z(), 0.0153333333, 1e-9);
}
} // namespace
} // namespace ode_predictive_space::haptics
