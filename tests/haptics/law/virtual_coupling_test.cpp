#include "ode_predictive_space/haptics/law/virtual_coupling.h"

#include <gtest/gtest.h>

#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/random_numbers.h"

namespace ode_predictive_space::haptics
{
namespace
{
const CouplingProperties strong = {400, 2, 0.8, 0.01};

TEST(VirtualCoupling, TurnsTheDeviceTowardsTheToolByTheShorterWay)
{
    RandomNumbers random(2);
    for (int i = 0; i < 2000; ++i)
    {
        ToolState device, tool;
        const Vector3 axis = random.direction();
        const double angle = random.between(-M_PI, M_PI);
        device.orientation = random.rotation();
        tool.orientation = Quaternion(Eigen::AngleAxisd(angle, axis)) * device.orientation;
        if (random.one_in(2))
            tool.orientation.coeffs() *= -1; // the same orientation
        const Wrench wrench = wrench_on_device(strong, device, tool);
        EXPECT_NEAR((wrench.torque - 0.8 * angle * axis).norm(), 0, 1e-9);
    }
}

TEST(VirtualCoupling, DampsTheMotionOfTheToolRelativeToTheDevice)
{
    RandomNumbers random(3);
    const ToolState device = random.tool();
    ToolState tool = random.tool();
    tool.orientation = device.orientation;
    const Wrench wrench = wrench_on_device(strong, device, tool);
    const Vector3 spring = 400 * (tool.position - device.position);
    EXPECT_NEAR((wrench.force - spring - 2 * (tool.linear_velocity - device.linear_velocity)).norm(), 0, 1e-9);
    EXPECT_NEAR((wrench.torque - 0.01 * (tool.angular_velocity - device.angular_velocity)).norm(), 0, 1e-9);
}

TEST(VirtualCoupling, IsBoundedToHalfOfWhatDiverges)
{
    const CouplingProperties most = bounded({1e9, 1e9, 1e9, 1e9}, 0.05, 1e-5, dt);
    EXPECT_NEAR(dt * dt * most.stiffness + 2 * dt * most.damping, 2 * 0.05, 1e-12);
    EXPECT_NEAR(dt * dt * most.angular_stiffness + 2 * dt * most.angular_damping, 2 * 1e-5, 1e-15);
}

TEST(VirtualCoupling, RefusesPropertiesThatCannotBe)
{
    for (const double bad : {-1.0, nan, infinity})
    {
        EXPECT_THROW(check(CouplingProperties{bad, 0, 0, 0}), std::invalid_argument);
        EXPECT_THROW(check(CouplingProperties{0, bad, 0, 0}), std::invalid_argument);
        EXPECT_THROW(check(CouplingProperties{0, 0, bad, 0}), std::invalid_argument);
        EXPECT_THROW(check(CouplingProperties{0, 0, 0, bad}), std::invalid_argument);
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
