#include "ode_predictive_space/haptics/contact/closest_point.h"

#include <gtest/gtest.h>
#include <limits>

#include "tests/haptics/allocation_count.h"
#include "tests/haptics/random_numbers.h"

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

TEST(ClosestPoint, OfNoPlaneIsTheTool)
{
    std::vector<ConstraintPlane> none;
    EXPECT_TRUE(find_closest_point(none));
}

TEST(ClosestPoint, OfOnePlaneIsItsDepthExactly)
{
    RandomNumbers random(1);
    for (int i = 0; i < 1000; ++i)
    {
        const double depth = random.between(0, 0.01);
        std::vector<ConstraintPlane> planes = {plane(random.direction(), depth)};
        EXPECT_TRUE(find_closest_point(planes));
        EXPECT_EQ(planes[0].share, depth);
    }
}

TEST(ClosestPoint, APlaneInFrontOfWhichTheToolIsDoesNothing)
{
    std::vector<ConstraintPlane> planes = {plane(Vector3::UnitX(), 0.01), plane(Vector3::UnitY(), 0)};
    EXPECT_TRUE(find_closest_point(planes));
    EXPECT_EQ(planes[0].share, 0.01);
    EXPECT_EQ(planes[1].share, 0);
}

// Alternating projections with corrections (Dykstra 1983) go to the same point on a way that has nothing in common with ours.
TEST(ClosestPoint, IsWhereDykstrasProjectionsEnd)
{
    RandomNumbers random(2);
    int found = 0;
    for (int i = 0; i < 500; ++i)
    {
        std::vector<ConstraintPlane> planes;
        const Vector3 free_point = random.direction();
        for (int k = 0; k < 6; ++k)
        {
            Vector3 normal = random.direction();
            normal = normal.dot(free_point) < 0 ? Vector3(-normal) : normal;
            planes.push_back(plane(normal, random.between(0, normal.dot(free_point))));
        }
        if (!find_closest_point(planes))
            continue;
        ++found;

        Vector3 point = Vector3::Zero();
        std::vector<double> corrections(planes.size(), 0);
        for (int round = 0; round < 3000; ++round)
            for (std::size_t k = 0; k < planes.size(); ++k)
            {
                const Vector3 start = point - corrections[k] * planes[k].normal;
                corrections[k] = std::max(0.0, planes[k].depth - planes[k].normal.dot(start));
                point = start + corrections[k] * planes[k].normal;
            }
        EXPECT_NEAR((point - lift_of(planes)).norm(), 0, 1e-4);
        EXPECT_LE(lift_of(planes).norm(), 1 + 1e-9); // the free point is no nearer
    }
    EXPECT_GT(found, 450);
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
        // All through the line along y at this point: their normals lie in one plane.
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

// From a scan's edges. Either plane alone misses the other's depth by more than 1e-9 of it, and the corner of both cannot be told from
// their numbers.
TEST(ClosestPoint, IsFoundWhereRoundingHidesTheCornerOfTwoPlanes)
{
    std::vector<ConstraintPlane> planes = {
        plane({3.6040162085170895e-05, 0, 0.99999999935055339}, 0.015333333329842769),
        plane({0, -3.2436145965682079e-05, 0.99999999947394824}, 0.015333333330505978)};
    EXPECT_TRUE(find_closest_point(planes));
    EXPECT_LE(worst_violation(planes, lift_of(planes)), 1e-6 * 0.0154);
    EXPECT_NEAR(lift_of(planes).z(), 0.0153333333, 1e-9);
}

TEST(ClosestPoint, OfOppositePlanesThereIsNone)
{
    std::vector<ConstraintPlane> planes = {plane(Vector3::UnitX(), 0.01), plane(-Vector3::UnitX(), 0.02)};
    EXPECT_FALSE(find_closest_point(planes));
    EXPECT_EQ(planes[0].share, 0.01);
    EXPECT_EQ(planes[1].share, 0.02);
}

TEST(ClosestPoint, OfAClosedCellThereIsNone)
{
    // The four faces of a tetrahedron that look outwards leave no room.
    std::vector<ConstraintPlane> planes;
    for (const Vector3 &corner : {Vector3(1, 1, 1), Vector3(1, -1, -1), Vector3(-1, 1, -1), Vector3(-1, -1, 1)})
        planes.push_back(plane(corner.normalized(), 0.01));
    EXPECT_FALSE(find_closest_point(planes));
    for (const ConstraintPlane &each : planes)
        EXPECT_EQ(each.share, 0.01);
}

TEST(ClosestPoint, ThatIsTooFarIsNone)
{
    const auto wedge = [](double half_angle) {
        const double sine = std::sin(half_angle), cosine = std::cos(half_angle);
        return std::vector<ConstraintPlane>{plane({cosine, sine, 0}, 0.01), plane({-cosine, sine, 0}, 0.01)};
    };
    std::vector<ConstraintPlane> blunt = wedge(std::asin(1 / 99.0)), sharp = wedge(std::asin(1 / 101.0));
    EXPECT_TRUE(find_closest_point(blunt));
    EXPECT_NEAR(lift_of(blunt).norm(), 0.99, 1e-9);
    EXPECT_FALSE(find_closest_point(sharp));
    EXPECT_EQ(sharp[0].share, 0.01);
}

TEST(ClosestPoint, OfWhatIsNotANumberThereIsNone)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<ConstraintPlane> planes = {plane(Vector3::UnitX(), 0.01), plane(Vector3::UnitY(), nan)};
    EXPECT_FALSE(find_closest_point(planes));
    EXPECT_EQ(planes[0].share, 0.01);
    EXPECT_TRUE(std::isnan(planes[1].share));
}

TEST(ClosestPoint, AsksForNoMemory)
{
    RandomNumbers random(5);
    std::vector<ConstraintPlane> planes;
    for (int k = 0; k < 20; ++k)
        planes.push_back(plane((Vector3::UnitZ() + random.in_cube(0.8)).normalized(), random.between(0, 0.01)));
    const std::uint64_t before = allocation_count();
    find_closest_point(planes);
    EXPECT_EQ(allocation_count(), before);
}
} // namespace
} // namespace ode_predictive_space::haptics
