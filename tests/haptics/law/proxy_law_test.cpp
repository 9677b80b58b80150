#include "ode_predictive_space/haptics/proxy_law.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/haptics/law/rendered_law.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/random_numbers.h"

namespace ode_predictive_space::haptics
{
namespace
{
Touch touch_of(std::uintptr_t object, const Vector3 &normal, double depth)
{
    Touch touch;
    touch.object = object;
    touch.normal = normal;
    touch.depth = depth;
    return touch;
}

/// Touches that leave a point 5 mm from the tool free; the normal of the first points to it.
std::vector<Touch> roomy_touches(RandomNumbers &random, int count)
{
    const Vector3 free_point = 0.005 * random.direction();
    std::vector<Touch> touches = {touch_of(1, free_point.normalized(), random.between(0.002, 0.005))};
    for (int object = 2; object <= count; ++object)
    {
        Vector3 normal = random.direction();
        if (normal.dot(free_point) < 0)
            normal = -normal;
        touches.push_back(
            touch_of(static_cast<std::uintptr_t>(object), normal, random.between(0, normal.dot(free_point))));
    }
    return touches;
}

TEST(ProxyLaw, TheProxyIsOutsideOfEverythingAndAsNearAsCanBe)
{
    RandomNumbers random(2);
    int carriers_seen[5] = {};
    for (int i = 0; i < 5000; ++i)
    {
        Rendered<ProxyLaw> law({1000, 0, 0});
        const ToolState tool = random.tool();
        const std::vector<Touch> touches = roomy_touches(random, 1 + random.below(8));
        TouchForces forces;
        law.forces(tool, touches, dt, forces);

        // The conditions of Karush, Kuhn and Tucker are necessary and, because the problem is convex, sufficient.
        const Vector3 offset = law.proxy() - tool.position;
        int carriers = 0;
        for (std::size_t touch = 0; touch < touches.size(); ++touch)
        {
            const double push = forces[touch].dot(touches[touch].normal);
            const double room = touches[touch].normal.dot(offset) - touches[touch].depth;
            EXPECT_GE(room, -1e-9);
            EXPECT_GE(push, 0);
            EXPECT_NEAR((forces[touch] - push * touches[touch].normal).norm(), 0, 1e-12);
            if (push > 0)
            {
                EXPECT_NEAR(room, 0, 1e-9);
                ++carriers;
            }
        }
        EXPECT_NEAR((sum_of(forces) - 1000 * offset).norm(), 0, 1e-9);
        ASSERT_LE(carriers, 3);
        ++carriers_seen[carriers];
    }
    for (int carriers = 1; carriers <= 3; ++carriers)
        EXPECT_GT(carriers_seen[carriers], 100) << carriers;
}

TEST(ProxyLaw, InASlitThatIsTooNarrowEachWallPushesAsIfAlone)
{
    TouchForces forces;
    for (const double tilt : {0.0, 1e-9, 0.001}) // a wedge of so small an angle has its edge far away
    {
        Rendered<ProxyLaw> law({1000, 0, 0});
        const Vector3 left = Vector3::UnitX();
        const Vector3 right = Vector3(-1, tilt, 0).normalized();
        law.forces({}, {touch_of(1, left, 0.003), touch_of(2, right, 0.001)}, dt, forces);
        EXPECT_NEAR((forces[0] - 3 * left).norm(), 0, 1e-12);
        EXPECT_NEAR((forces[1] - right).norm(), 0, 1e-12);
    }
}

TEST(ProxyLaw, WithFrictionTheProxyStaysOutsideAndForcesAddUpToItsSpring)
{
    RandomNumbers random(5);
    TouchForces forces;
    for (int run = 0; run < 500; ++run)
    {
        Rendered<ProxyLaw> law({800, 0, run % 2 == 0 ? 0.7 : 1.5});
        const std::vector<Touch> touches = roomy_touches(random, 1 + random.below(5));
        ToolState tool = random.tool();
        for (int tick = 0; tick < 20; ++tick)
        {
            tool.position += random.in_cube(0.003);
            law.forces(tool, touches, dt, forces);
            EXPECT_NEAR((sum_of(forces) - 800 * (law.proxy() - tool.position)).norm(), 0, 1e-9);
            for (const Touch &touch : touches)
                EXPECT_GE(touch.normal.dot(law.proxy() - tool.position) - touch.depth, -1e-9);
        }
    }
}

TEST(ProxyLaw, InAGrooveFrictionActsAlongItOnly)
{
    const Vector3 left = Vector3(1, 0, 1).normalized(), right = Vector3(-1, 0, 1).normalized();
    const std::vector<Touch> groove = {touch_of(1, left, 0.002), touch_of(2, right, 0.002)};
    Rendered<ProxyLaw> law({1000, 0, 0.1});
    ToolState tool;
    TouchForces forces;
    law.forces(tool, groove, dt, forces);
    tool.position = Vector3(0.01, 0.01, 0);
    law.forces(tool, groove, dt, forces);
    EXPECT_NEAR(sum_of(forces).x(), 0, 1e-9);
    EXPECT_NEAR(sum_of(forces).y(), -0.1 * (2 + 2), 1e-9); // both walls press with 2 N
    EXPECT_NEAR(forces[0].y(), forces[1].y(), 1e-12);
}

TEST(ProxyLaw, AGrooveThatMovesTakesTheProxyAlongAtItsSpeed)
{
    std::vector<Touch> groove = {touch_of(1, Vector3(1, 0, 1).normalized(), 0.002),
                                 touch_of(2, Vector3(-1, 0, 1).normalized(), 0.002)};
    for (Touch &touch : groove)
        touch.surface_velocity.y() = 0.1;
    Rendered<ProxyLaw> law({1000, 0, 0.5});
    TouchForces forces;
    for (int tick = 0; tick <= 10; ++tick)
        law.forces({}, groove, dt, forces);
    EXPECT_NEAR(sum_of(forces).y(), 1000 * 0.1 * dt * 10, 1e-9);
}

/// ODE's contact of a point that enters a plate of 4 mm from above: on the nearer side.
Touch touch_of_plate(double height, double top)
{
    const double below_top = top - height, above_bottom = height - (top - 0.004);
    return below_top < above_bottom ? touch_of(7, Vector3::UnitZ(), below_top)
                                    : touch_of(7, -Vector3::UnitZ(), above_bottom);
}

TEST(ProxyLaw, IsNotPushedOutAtTheBackOfAThinObject)
{
    Rendered<ProxyLaw> law({1000, 0, 0.3});
    ToolState tool;
    TouchForces forces;
    for (int tick = 1; tick < 79; ++tick)
    {
        const double depth = 0.0001 * std::min(tick, 79 - tick); // in and out again
        tool.position.z() = -depth;
        law.forces(tool, {touch_of_plate(tool.position.z(), 0)}, dt, forces);
        EXPECT_NEAR(forces[0].z(), 1000 * depth, 1e-9);
        EXPECT_NEAR(law.proxy().z(), 0, 1e-12);
    }
}

TEST(ProxyLaw, TheFrontOfAThinObjectMovesWithIt)
{
    Rendered<ProxyLaw> law({1000, 0, 0});
    TouchForces forces;
    const double speed = 0.1;
    for (int tick = 1; tick < 40; ++tick) // the plate rises over the tool, which rests
    {
        const double top = speed * dt * tick;
        Touch touch = touch_of_plate(0, top);
        touch.surface_velocity.z() = speed;
        law.forces({}, {touch}, dt, forces);
        EXPECT_NEAR(forces[0].z(), 1000 * top, 1e-9);
    }
}

TEST(ProxyLaw, AfterLeavingAnObjectBelievesEitherSideOfIt)
{
    Rendered<ProxyLaw> law({1000, 0, 0});
    TouchForces forces;
    const Touch front = touch_of(7, Vector3::UnitZ(), 0.001), back = touch_of(7, -Vector3::UnitZ(), 0.001);
    law.forces({}, {front}, dt, forces);
    law.forces({}, {}, dt, forces);
    law.forces({}, {back}, dt, forces);
    EXPECT_EQ(forces[0], Vector3(0, 0, -1));
    law.reset();
    law.forces({}, {front}, dt, forces);
    EXPECT_EQ(forces[0], Vector3(0, 0, 1));
}

TEST(ProxyLaw, TakesHoldWhereTheToolCameIn)
{
    Rendered<ProxyLaw> law({1000, 0, 0.5});
    ToolState tool;
    TouchForces forces;
    law.forces(tool, {}, dt, forces);
    EXPECT_EQ(law.proxy(), tool.position);
    tool.position = Vector3(0.0004, 0, -0.001);
    law.forces(tool, {touch_of(1, Vector3::UnitZ(), 0.001)}, dt, forces);
    EXPECT_NEAR(law.proxy().norm(), 0, 1e-12);
    EXPECT_NEAR((forces[0] - Vector3(-0.4, 0, 1)).norm(), 0, 1e-9);
}
} // namespace
} // namespace ode_predictive_space::haptics
