#include "ode_predictive_space/haptics/law/virtual_coupling.h"

#include <gtest/gtest.h>
#include <limits>

#include "tests/haptics/allocation_count.h"
#include "tests/haptics/random_numbers.h"

namespace ode_predictive_space::haptics
{
namespace
{
const CouplingProperties strong = {400, 2, 0.8, 0.01};

TEST(VirtualCoupling, IsAtRestWhereBothAgree)
{
    RandomNumbers random(1);
    const ToolState state = random.tool();
    const Wrench wrench = wrench_on_device(strong, state, state);
    EXPECT_EQ(wrench.force.norm(), 0);
    EXPECT_NEAR(wrench.torque.norm(), 0, 1e-12);
}

TEST(VirtualCoupling, IsASpringAndADamperOnPositions)
{
    ToolState device, tool;
    device.position = Vector3(0.01, 0, 0);
    device.linear_velocity = Vector3(0, 0.1, 0);
    tool.linear_velocity = Vector3(0, 0, 0.3);
    const Wrench wrench = wrench_on_device(strong, device, tool);
    EXPECT_NEAR((wrench.force - Vector3(-4, -0.2, 0.6)).norm(), 0, 1e-12);
    EXPECT_EQ(wrench.torque.norm(), 0);
}

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

TEST(VirtualCoupling, IsExactForTheSmallestAngles)
{
    ToolState device, tool;
    for (const double angle : {1e-3, 1e-8, 1e-12})
    {
        tool.orientation = Quaternion(Eigen::AngleAxisd(angle, Vector3::UnitY()));
        EXPECT_NEAR(wrench_on_device(strong, device, tool).torque.y() / (0.8 * angle), 1, 1e-12);
    }
}

TEST(VirtualCoupling, DampsTurning)
{
    ToolState device, tool;
    device.angular_velocity = Vector3(1, 0, 0);
    tool.angular_velocity = Vector3(0, 2, 0);
    EXPECT_NEAR((wrench_on_device(strong, device, tool).torque - Vector3(-0.01, 0.02, 0)).norm(), 0, 1e-15);
}

TEST(VirtualCoupling, DrawsABodyToTheHandAndKeepsMomentum)
{
    const double mass = 0.1, dt = 0.001;
    const CouplingProperties coupling = {200, 5, 0, 0};
    ToolState hand, tool;
    hand.position = Vector3(0.05, 0.02, 0);
    Vector3 impulse_on_hand = Vector3::Zero();
    for (int tick = 0; tick < 2000; ++tick)
    {
        const Wrench wrench = wrench_on_device(coupling, hand, tool);
        impulse_on_hand += wrench.force * dt;
        tool.linear_velocity += -wrench.force / mass * dt;
        tool.position += tool.linear_velocity * dt;
        EXPECT_NEAR((impulse_on_hand + mass * tool.linear_velocity).norm(), 0, 1e-12);
    }
    EXPECT_NEAR((tool.position - hand.position).norm(), 0, 1e-6);
}

TEST(VirtualCoupling, RefusesPropertiesThatCannotBe)
{
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    {
        EXPECT_THROW(check(CouplingProperties{bad, 0, 0, 0}), std::invalid_argument);
        EXPECT_THROW(check(CouplingProperties{0, bad, 0, 0}), std::invalid_argument);
        EXPECT_THROW(check(CouplingProperties{0, 0, bad, 0}), std::invalid_argument);
        EXPECT_THROW(check(CouplingProperties{0, 0, 0, bad}), std::invalid_argument);
    }
}

TEST(VirtualCoupling, AsksForNoMemory)
{
    RandomNumbers random(4);
    const ToolState device = random.tool(), tool = random.tool();
    const std::uint64_t before = allocation_count();
    const Wrench wrench = wrench_on_device(strong, device, tool);
    EXPECT_EQ(allocation_count(), before);
    EXPECT_TRUE(wrench.force.allFinite());
}
} // namespace
} // namespace ode_predictive_space::haptics
