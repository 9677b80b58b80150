#include "ode_predictive_space/haptics/contact/yielding_place.h"

#include "tests/haptics/constants.h"
#include "tests/haptics/random_numbers.h"

#include <cmath>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
TEST(YieldingPlace, APlaneAloneCarriesItsDepth)
{
    std::vector<ConstraintPlane> planes = {{Vector3::UnitX(), 0.003, 1e-6}};
    find_yielding_place(planes);
    EXPECT_NEAR(planes[0].share, 0.003, 1e-12);
    planes[0].yield = 0.1;
    find_yielding_place(planes);
    EXPECT_NEAR(planes[0].share, 0.003, 0.003 * 0.001);
}

TEST(YieldingPlace, WhatHasNoDepthCarriesNothing)
{
    std::vector<ConstraintPlane> planes = {{Vector3::UnitX(), -0.003, 0.1}, {Vector3::UnitY(), 0, 0.1}};
    find_yielding_place(planes);
    EXPECT_EQ(planes[0].share, 0);
    EXPECT_EQ(planes[1].share, 0);
    find_yielding_place(planes = {});
    EXPECT_TRUE(planes.empty());
}

TEST(YieldingPlace, ANotchBetweenHeavyPlanesIsExact)
{
    for (const double degrees : {90.0, 10.0, 1.5})
    {
        const double half = degrees * M_PI / 360;
        const Vector3 left(std::cos(half), 0, std::sin(half)), right(-std::cos(half), 0, std::sin(half));
        std::vector<ConstraintPlane> planes = {{left, 0.001, 1e-6}, {right, 0.001, 1e-6}};
        find_yielding_place(planes);
        EXPECT_NEAR(lift_of(planes).z(), 0.001 / std::sin(half), 1e-6 * 0.001 / std::sin(half)) << degrees;
    }
}

TEST(YieldingPlace, BetweenNearlyOppositePlanesThatYieldSharesAreBounded)
{
    for (const double degrees : {10.0, 1.0, 0.001, 0.0})
    {
        const double half = degrees * M_PI / 360;
        const Vector3 left(std::cos(half), 0, std::sin(half)), right(-std::cos(half), 0, std::sin(half));
        std::vector<ConstraintPlane> planes = {{left, 0.001, 0.1}, {right, 0.001, 0.1}};
        find_yielding_place(planes);
        for (const ConstraintPlane &plane : planes)
            EXPECT_LE(plane.share, 3 * 0.001 / 0.1 * (1 + 1e-9)) << degrees;
    }
}

TEST(YieldingPlace, AnyNumberOfPlanesChangesLittleBySmallMotions)
{
    RandomNumbers random(5);
    std::vector<ConstraintPlane> planes;
    for (int i = 0; i < 256; ++i)
        planes.push_back({(random.direction() + Vector3::UnitZ()).normalized(), random.between(-0.01, 0.01), 0.1});
    find_yielding_place(planes);
    const Vector3 lift = lift_of(planes);
    EXPECT_GT(lift.z(), 0);
    std::vector<ConstraintPlane> moved = planes;
    for (ConstraintPlane &plane : moved)
        plane.depth += random.between(-1e-6, 1e-6);
    find_yielding_place(moved);
    for (std::size_t i = 0; i < planes.size(); ++i)
        EXPECT_NEAR(moved[i].share, planes[i].share, 1e-4);
}

TEST(YieldingPlace, WhatIsNotFiniteIsKept)
{
    std::vector<ConstraintPlane> planes = {{Vector3::UnitX(), nan, 0.1}, {Vector3::UnitY(), 0.002, 0.1}};
    find_yielding_place(planes);
    EXPECT_TRUE(std::isnan(planes[0].share));
}
} // namespace
} // namespace ode_predictive_space::haptics
