#include "ode_predictive_space/haptics/force_law.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>

#include "ode_predictive_space/haptics/penalty_law.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "tests/haptics/law/rendered_law.h"
#include "tests/haptics/support/allocation_count.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/random_numbers.h"

namespace ode_predictive_space::haptics
{
namespace
{
class SurfaceLaw : public testing::TestWithParam<const char *>
{
protected:
    std::unique_ptr<ForceLaw> make(const Material &properties)
    {
        if (GetParam() == std::string("penalty"))
            return std::make_unique<Rendered<PenaltyLaw>>(properties);
        return std::make_unique<Rendered<ProxyLaw>>(properties);
    }

    void expect_spring(double stiffness, const ToolState &tool, const Touch &touch)
    {
        TouchForces forces;
        make({stiffness, 0, 0})->forces(tool, {touch}, dt, forces);
        ASSERT_EQ(forces.size(), 1u);
        const Vector3 truth = stiffness * touch.depth * touch.normal;
        EXPECT_LE((forces[0] - truth).norm(), 1e-9);
    }
};

INSTANTIATE_TEST_SUITE_P(Laws, SurfaceLaw, testing::Values("penalty", "proxy"));

TEST_P(SurfaceLaw, IsTheSpringOfThePaperOnPlanes)
{
    RandomNumbers random(1);
    for (int i = 0; i < 2000; ++i)
    {
        const Vector3 normal = random.direction();
        ToolState tool = random.tool();
        Touch touch;
        touch.normal = normal;
        touch.depth = random.between(0, 2 * radius);
        touch.point = tool.position - (radius - touch.depth) * normal;
        expect_spring(random.between(0, 5000), tool, touch);
    }
}

TEST_P(SurfaceLaw, DampingResistsApproachAndNeverPulls)
{
    Touch touch;
    touch.normal = Vector3::UnitY();
    touch.depth = 0.002;
    touch.surface_velocity = Vector3(0, 0.1, 0);
    ToolState tool;
    TouchForces forces;
    const auto law = make({500, 5, 0});

    Touch covered = touch; // the first one carries the tool alone
    covered.depth = 0.001;
    tool.linear_velocity = Vector3(3, -0.2, 0); // 0.3 m/s towards the surface
    law->forces(tool, {touch, covered}, dt, forces);
    EXPECT_NEAR(forces[0].y(), 1 + 5 * 0.3, 1e-12);
    EXPECT_EQ(forces[0].x(), 0);
    EXPECT_EQ(forces[1].norm(), 0);

    tool.linear_velocity = Vector3(0, 0.2, 0); // 0.1 m/s away
    law->forces(tool, {touch}, dt, forces);
    EXPECT_NEAR(forces[0].y(), 1 - 5 * 0.1, 1e-12);

    tool.linear_velocity = Vector3(0, 2, 0);
    law->forces(tool, {touch}, dt, forces);
    EXPECT_EQ(forces[0].norm(), 0);
}

TEST_P(SurfaceLaw, FrictionHoldsThenSlipsAtItsLimit)
{
    Touch floor;
    floor.normal = Vector3::UnitZ();
    floor.depth = 0.004; // 2 N
    ToolState tool;
    TouchForces forces;
    const auto law = make({500, 0, 0.5});
    law->forces(tool, {floor}, dt, forces);
    EXPECT_NEAR(forces[0].head<2>().norm(), 0, 1e-15);

    for (int tick = 1; tick <= 20; ++tick) // 1 N after 2 mm
    {
        tool.position.x() = tick * 0.0001;
        law->forces(tool, {floor}, dt, forces);
        EXPECT_NEAR(forces[0].x(), -500 * tool.position.x(), 1e-9);
        EXPECT_NEAR(forces[0].z(), 2, 1e-12);
    }
    for (int tick = 21; tick <= 60; ++tick)
    {
        tool.position.x() = tick * 0.0001;
        law->forces(tool, {floor}, dt, forces);
        EXPECT_NEAR(forces[0].x(), -1, 1e-9);
    }
    for (int tick = 1; tick <= 500; ++tick) // at rest, it holds by the same force and neither creeps nor chatters
    {
        law->forces(tool, {floor}, dt, forces);
        EXPECT_NEAR(forces[0].x(), -1, 1e-9);
    }
    tool.position.x() -= 0.001; // back within the hold
    law->forces(tool, {floor}, dt, forces);
    EXPECT_NEAR(forces[0].x(), -0.5, 1e-9);
}

TEST_P(SurfaceLaw, StaticFrictionAloneHoldsUntilItSlips)
{
    Touch floor;
    floor.depth = 0.004; // 2 N
    ToolState tool;
    TouchForces forces;
    const auto law = make({500, 0, 0, 0.5});
    law->forces(tool, {floor}, dt, forces);
    tool.position.x() = 0.0019;
    law->forces(tool, {floor}, dt, forces);
    EXPECT_NEAR(forces[0].x(), -0.95, 1e-9);
    tool.position.x() = 0.0021;
    law->forces(tool, {floor}, dt, forces);
    EXPECT_NEAR(forces[0].x(), 0, 1e-12);
}

TEST_P(SurfaceLaw, FrictionIsWithinItsConeOnEveryTouch)
{
    RandomNumbers random(6);
    const double friction = 0.6;
    const auto law = make({700, 0, friction});
    TouchForces forces;
    double most = 0; // largest ratio of tangential to normal force
    for (int run = 0; run < 200; ++run)
    {
        ToolState tool = random.tool();
        std::vector<Touch> touches = random.touches(1 + random.below(4));
        law->reset();
        for (int tick = 0; tick < 30; ++tick)
        {
            tool.position += random.in_cube(0.002);
            law->forces(tool, touches, dt, forces);
            for (std::size_t i = 0; i < touches.size(); ++i)
            {
                const double pressure = forces[i].dot(touches[i].normal);
                const double tangential = (forces[i] - pressure * touches[i].normal).norm();
                EXPECT_LE(tangential, friction * pressure + 1e-9);
                if (pressure > 0)
                    most = std::max(most, tangential / pressure);
            }
        }
    }
    EXPECT_NEAR(most, friction, 1e-6);
}

TEST_P(SurfaceLaw, AMovingSurfaceDragsTheHandAlong)
{
    Touch belt;
    belt.normal = Vector3::UnitZ();
    belt.depth = 0.004; // 2 N
    belt.surface_velocity = Vector3(0, 0.1, 0);
    TouchForces forces;
    const auto law = make({500, 0, 0.5});
    law->forces({}, {belt}, dt, forces);
    for (int tick = 1; tick <= 100; ++tick)
    {
        law->forces({}, {belt}, dt, forces);
        EXPECT_NEAR(forces[0].y(), std::min(1.0, 500 * 0.1 * dt * tick), 1e-9);
    }
    EXPECT_NEAR(forces[0].y(), 1, 1e-9);
    EXPECT_NEAR(forces[0].x(), 0, 1e-12);
}

TEST_P(SurfaceLaw, ForgetsItsHoldWhenReset)
{
    Touch floor;
    floor.depth = 0.004;
    ToolState tool;
    TouchForces forces;
    const auto law = make({500, 0, 0.5});
    law->forces(tool, {floor}, dt, forces);
    tool.position.x() = 0.001;
    law->forces(tool, {floor}, dt, forces);
    EXPECT_GT(forces[0].head<2>().norm(), 0.1);
    law->reset();
    law->forces(tool, {floor}, dt, forces);
    EXPECT_NEAR(forces[0].head<2>().norm(), 0, 1e-12);
}

TEST_P(SurfaceLaw, ShowsNonsenseAndForgetsIt)
{
    for (int what = 0; what < 7; ++what)
    {
        const auto law = make({500, 1, what < 4 ? 0.5 : 0});
        Touch touch;
        touch.depth = 0.004;
        TouchForces forces;
        law->forces({}, {touch}, dt, forces);

        ToolState bad_tool;
        Touch bad_touch = touch;
        double *const places[] = {&bad_tool.position.y(), &bad_touch.depth, &bad_touch.normal.x(),
                                  &bad_touch.surface_velocity.z()};
        *places[what < 4 ? what : what - 3] = nan; // without friction, nothing depends on the tool's position
        law->forces(bad_tool, {bad_touch}, dt, forces);
        EXPECT_FALSE(forces[0].allFinite()) << what;

        for (int tick = 0; tick < 3; ++tick)
            law->forces({}, {touch}, dt, forces);
        EXPECT_NEAR(forces[0].z(), 2, 1e-9) << what;
        EXPECT_TRUE(forces[0].allFinite()) << what;
    }
}

TEST_P(SurfaceLaw, AsksForNoMemoryInTheSteadyState)
{
    RandomNumbers random(7);
    const auto law = make({700, 2, 0.4});
    TouchForces forces;
    std::vector<std::vector<Touch>> ticks;
    for (int tick = 0; tick < 200; ++tick)
        ticks.push_back(random.touches(random.below(9)));
    ticks[0] = random.touches(8);
    ticks[1] = ticks[0];
    const ToolState tool = random.tool();

    law->forces(tool, ticks[0], dt, forces);
    law->forces(tool, ticks[1], dt, forces);
    const std::uint64_t before = allocation_count();
    for (const std::vector<Touch> &touches : ticks)
        law->forces(tool, touches, dt, forces);
    EXPECT_EQ(allocation_count(), before);
}

TEST_P(SurfaceLaw, RefusesPropertiesThatCannotBe)
{
    for (const double bad : {-1.0, nan, infinity})
    {
        EXPECT_THROW(make({bad, 0, 0}), std::invalid_argument);
        EXPECT_THROW(make({500, bad, 0}), std::invalid_argument);
        EXPECT_THROW(make({500, 0, bad}), std::invalid_argument);
        EXPECT_THROW(make({500, 0, 0, bad}), std::invalid_argument);
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
