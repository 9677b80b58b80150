#include "ode_predictive_space/haptics/penalty_law.h"

#include <gtest/gtest.h>

#include "tests/haptics/law/rendered_law.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/random_numbers.h"

namespace ode_predictive_space::haptics
{
namespace
{
TEST(PenaltyLaw, TakesEachTouchAsIfItWereAlone)
{
    RandomNumbers random(1);
    for (int i = 0; i < 500; ++i)
    {
        Rendered<PenaltyLaw> law({800, 0, 0});
        const std::vector<Touch> touches = random.touches(5);
        TouchForces forces;
        law.forces(random.tool(), touches, dt, forces);
        for (std::size_t touch = 0; touch < touches.size(); ++touch)
            EXPECT_EQ(forces[touch], 800 * touches[touch].depth * touches[touch].normal);
    }
}

TEST(PenaltyLaw, TheHoldOnAnObjectGoesWithTheObjectNotWithItsPlaceInTheList)
{
    Rendered<PenaltyLaw> law({500, 0, 0.5});
    Touch floor, wall;
    floor.object = 1;
    floor.depth = 0.004;
    wall.object = 2;
    wall.normal = Vector3::UnitX();
    wall.depth = 0.004;
    ToolState tool;
    TouchForces forces;
    law.forces(tool, {floor, wall}, dt, forces);
    tool.position = Vector3(0, 0.001, 0);
    law.forces(tool, {wall, floor}, dt, forces);
    EXPECT_NEAR(forces[0].y(), -0.5, 1e-12);
    EXPECT_NEAR(forces[1].y(), -0.5, 1e-12);
}

TEST(PenaltyLaw, StaticFrictionAloneHoldsUntilItSlips)
{
    Material material{500};
    material.static_friction = 0.5;
    Rendered<PenaltyLaw> law(material);
    Touch floor;
    floor.depth = 0.004; // 2 N
    ToolState tool;
    TouchForces forces;
    law.forces(tool, {floor}, dt, forces);
    tool.position.x() = 0.001;
    law.forces(tool, {floor}, dt, forces);
    EXPECT_NEAR(forces[0].x(), -0.5, 1e-12);
    tool.position.x() = 0.0021;
    law.forces(tool, {floor}, dt, forces);
    EXPECT_NEAR(forces[0].x(), 0, 1e-12);
}

TEST(PenaltyLaw, ANewTouchTakesHoldWhereItIs)
{
    Rendered<PenaltyLaw> law({500, 0, 0.5});
    Touch floor;
    floor.depth = 0.004;
    ToolState tool;
    TouchForces forces;
    law.forces(tool, {}, dt, forces);
    tool.position.x() = 0.001;
    law.forces(tool, {floor}, dt, forces);
    EXPECT_EQ(forces[0].head<2>().norm(), 0);
    tool.position.x() = 0.002;
    law.forces(tool, {floor}, dt, forces);
    EXPECT_NEAR(forces[0].x(), -0.5, 1e-12);
}

// Another law was in its place meanwhile, and the tool has stayed on the floor.
TEST(PenaltyLaw, TakesHoldWhereItIsWhenItComesBack)
{
    PenaltyLaw law({500, 0, 0.5});
    Touch floor;
    floor.depth = 0.004;
    floor.takes_over = floor.id = 1;
    ToolState tool;
    TouchForces forces;
    law.forces(tool, {floor}, dt, forces);
    law.reset();
    tool.position.x() = 0.001;
    law.forces(tool, {floor}, dt, forces);
    EXPECT_EQ(forces[0].x(), 0);
}
} // namespace
} // namespace ode_predictive_space::haptics
