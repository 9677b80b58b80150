#include "ode_predictive_space/haptics/workspace.h"

#include <gtest/gtest.h>
#include <limits>

#include "tests/haptics/support/random_numbers.h"

namespace ode_predictive_space::haptics
{
namespace
{
DeviceState random_device(RandomNumbers &random)
{
    DeviceState device;
    device.position = random.in_cube(0.1);
    device.orientation = random.rotation();
    device.linear_velocity = random.in_cube(1);
    device.angular_velocity = random.in_cube(3);
    return device;
}

WorkspacePlacement random_placement(RandomNumbers &random)
{
    WorkspacePlacement placement;
    placement.scale = std::exp(random.between(-3, 3));
    placement.rotation = random.rotation();
    placement.offset = random.in_cube(5);
    return placement;
}

void expect_same(const ToolState &a, const ToolState &b, double tolerance)
{
    EXPECT_NEAR((a.position - b.position).norm(), 0, tolerance);
    EXPECT_NEAR(a.orientation.angularDistance(b.orientation), 0, tolerance);
    EXPECT_NEAR((a.linear_velocity - b.linear_velocity).norm(), 0, tolerance);
    EXPECT_NEAR((a.angular_velocity - b.angular_velocity).norm(), 0, tolerance);
}

TEST(WorkspaceMapping, ScalesTurnsAndShifts)
{
    WorkspacePlacement placement;
    placement.scale = 10;
    placement.rotation = WorkspacePlacement::z_up();
    placement.offset = Vector3(0, 0, 1);
    DeviceState device;
    device.position = Vector3(0.01, 0.02, -0.03); // to the right, up, away from the person
    device.linear_velocity = Vector3(0, 0.1, 0);
    device.angular_velocity = Vector3(0, 2, 0);
    const ToolState tool = WorkspaceMapping(placement).to_scene(device);
    EXPECT_NEAR((tool.position - Vector3(0.1, 0.3, 1.2)).norm(), 0, 1e-15);
    EXPECT_NEAR((tool.linear_velocity - Vector3(0, 0, 1)).norm(), 0, 1e-15);
    EXPECT_NEAR((tool.angular_velocity - Vector3(0, 0, 2)).norm(), 0, 1e-15);
}

TEST(WorkspaceMapping, ForcesAreTurnedBackAndNotScaled)
{
    RandomNumbers random(4);
    for (int i = 0; i < 1000; ++i)
    {
        const WorkspacePlacement placement = random_placement(random);
        const WorkspaceMapping mapping(placement);
        Wrench scene;
        scene.force = random.in_cube(8);
        scene.torque = random.in_cube(1);
        const Wrench device = mapping.to_device(scene);
        EXPECT_NEAR(device.force.norm(), scene.force.norm(), 1e-12);
        EXPECT_NEAR((placement.rotation * device.force - scene.force).norm(), 0, 1e-12);
        EXPECT_NEAR((placement.rotation * device.torque - scene.torque).norm(), 0, 1e-12);
    }
}

TEST(WorkspaceMapping, AForceScaleEqualToTheScaleKeepsThePower)
{
    RandomNumbers random(5);
    for (int i = 0; i < 1000; ++i)
    {
        WorkspacePlacement placement = random_placement(random);
        placement.force_scale = placement.scale;
        const WorkspaceMapping mapping(placement);
        const DeviceState device = random_device(random);
        Wrench scene;
        scene.force = random.in_cube(8);
        const double power = scene.force.dot(mapping.to_scene(device).linear_velocity);
        EXPECT_NEAR(mapping.to_device(scene).force.dot(device.linear_velocity) / power, 1, 1e-9);
    }
}

TEST(WorkspaceMapping, TellsHowStiffASpringFeels)
{
    RandomNumbers random(6);
    WorkspacePlacement placement = random_placement(random);
    placement.force_scale = 0.3;
    const WorkspaceMapping mapping(placement);
    DeviceState device = random_device(random);
    const Vector3 anchor = mapping.to_scene(device).position;
    const Vector3 step = random.in_cube(0.01);
    device.position += step;
    Wrench spring;
    spring.force = 500 * (anchor - mapping.to_scene(device).position);
    const double at_device = mapping.to_device(spring).force.norm() / step.norm();
    EXPECT_NEAR(mapping.stiffness_at_device(500), at_device, 1e-6 * at_device);
    EXPECT_NEAR(mapping.stiffness_in_scene(at_device), 500, 1e-3);
}

TEST(WorkspaceMapping, WhileTheClutchIsHeldTheToolStaysAndTheHandIsFree)
{
    RandomNumbers random(7);
    WorkspaceMapping mapping(random_placement(random));
    const DeviceState taken = random_device(random);
    ToolState expected = mapping.to_scene(taken);
    expected.linear_velocity.setZero();
    expected.angular_velocity.setZero();
    mapping.clutch(true, taken);
    EXPECT_TRUE(mapping.clutched());
    Wrench push;
    push.force = Vector3(1, 2, 3);
    push.torque = Vector3(1, 2, 3);
    for (int i = 0; i < 20; ++i)
    {
        const DeviceState moved = random_device(random);
        mapping.clutch(true, moved);
        expect_same(mapping.to_scene(moved), expected, 1e-12);
        EXPECT_EQ(mapping.to_device(push).force.norm(), 0);
        EXPECT_EQ(mapping.to_device(push).torque.norm(), 0);
    }
}

TEST(WorkspaceMapping, WhenTheClutchIsLetGoNothingJumps)
{
    RandomNumbers random(8);
    for (int i = 0; i < 500; ++i)
    {
        WorkspaceMapping mapping(random_placement(random));
        for (int use = 0; use < 5; ++use)
        {
            const DeviceState taken = random_device(random), let_go = random_device(random);
            const ToolState before = mapping.to_scene(taken);
            mapping.clutch(true, taken);
            mapping.clutch(false, let_go);
            EXPECT_FALSE(mapping.clutched());
            const ToolState after = mapping.to_scene(let_go);
            EXPECT_NEAR((after.position - before.position).norm(), 0, 1e-12);
            EXPECT_NEAR(after.orientation.angularDistance(before.orientation), 0, 1e-7);

            DeviceState moved = let_go;
            const Quaternion turn = random.rotation();
            moved.position += Vector3(0.01, 0, 0);
            moved.orientation = turn * let_go.orientation;
            const WorkspacePlacement &placement = mapping.placement();
            const ToolState tool = mapping.to_scene(moved);
            const Vector3 step = placement.scale * (placement.rotation * Vector3(0.01, 0, 0));
            const Quaternion turned = placement.rotation * turn * placement.rotation.conjugate();
            EXPECT_NEAR((tool.position - after.position - step).norm(), 0, 1e-12);
            EXPECT_NEAR(tool.orientation.angularDistance(turned * after.orientation), 0, 1e-7);
        }
    }
}

TEST(WorkspaceMapping, AMovedBaseCarriesWhatTheClutchHasShifted)
{
    RandomNumbers random(9);
    for (int i = 0; i < 500; ++i)
    {
        const WorkspacePlacement from = random_placement(random);
        WorkspacePlacement to = random_placement(random);
        to.scale = from.scale;
        WorkspaceMapping mapping(from);
        const DeviceState device = random_device(random);
        mapping.clutch(true, random_device(random));
        mapping.clutch(false, device);
        const ToolState before = mapping.to_scene(device);
        const BaseMotion motion = {random.in_cube(1), random.in_cube(1)};
        mapping.move_base(to, motion);
        const Quaternion turn = to.rotation * from.rotation.conjugate();
        ToolState expected;
        expected.position = to.offset + turn * (before.position - from.offset);
        expected.orientation = turn * before.orientation;
        expected.linear_velocity =
            turn * before.linear_velocity + motion.velocity + motion.spin.cross(expected.position - to.offset);
        expected.angular_velocity = turn * before.angular_velocity + motion.spin;
        expect_same(mapping.to_scene(device), expected, 1e-7);
    }
}

TEST(WorkspacePlacement, CoversTheSceneAndIsNoLargerThanItMust)
{
    RandomNumbers random(10);
    for (int i = 0; i < 500; ++i)
    {
        const Vector3 low = random.in_cube(2), device_low = random.in_cube(0.1);
        const Eigen::AlignedBox3d scene(low, low + Vector3::Ones() + random.in_cube(0.9));
        const Eigen::AlignedBox3d device(device_low, device_low + Vector3::Constant(0.1) + random.in_cube(0.05));
        const WorkspaceMapping mapping(WorkspacePlacement::covering(scene, device, random.rotation()));
        double most = 0; // farthest corner of the scene in the hand's frame; 1 is the workspace's end
        for (int corner = 0; corner < 8; ++corner)
        {
            const Vector3 at = scene.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
            const WorkspacePlacement &placed = mapping.placement();
            const Vector3 hand = placed.rotation.conjugate() * (at - placed.offset) / placed.scale - device.center();
            most = std::max(most, hand.cwiseAbs().cwiseQuotient(device.sizes() / 2).maxCoeff());
        }
        EXPECT_NEAR(most, 1, 1e-9);
    }
}

TEST(WorkspacePlacement, RefusesBoxesThatCannotBeCovered)
{
    const Eigen::AlignedBox3d box(Vector3::Zero(), Vector3::Ones()), flat(Vector3::Zero(), Vector3(1, 0, 1));
    const Eigen::AlignedBox3d point(Vector3::Ones(), Vector3::Ones());
    const Eigen::AlignedBox3d endless(Vector3::Zero(), Vector3::Constant(std::numeric_limits<double>::infinity()));
    EXPECT_THROW(WorkspacePlacement::covering(Eigen::AlignedBox3d(), box), std::invalid_argument);
    EXPECT_THROW(WorkspacePlacement::covering(box, Eigen::AlignedBox3d()), std::invalid_argument);
    EXPECT_THROW(WorkspacePlacement::covering(endless, box), std::invalid_argument);
    EXPECT_THROW(WorkspacePlacement::covering(box, flat), std::invalid_argument);
    EXPECT_THROW(WorkspacePlacement::covering(point, box), std::invalid_argument);
    EXPECT_NO_THROW(WorkspacePlacement::covering(flat, box));
}

TEST(WorkspaceMapping, RefusesAPlacementThatCannotBe)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    WorkspacePlacement placement;
    for (const double bad : {0.0, -1.0, nan})
    {
        placement = {};
        placement.scale = bad;
        EXPECT_THROW(WorkspaceMapping{placement}, std::invalid_argument);
        placement = {};
        placement.force_scale = bad;
        EXPECT_THROW(WorkspaceMapping{placement}, std::invalid_argument);
    }
    placement = {};
    placement.rotation.coeffs() *= 2;
    EXPECT_THROW(WorkspaceMapping{placement}, std::invalid_argument);
    placement.rotation.coeffs() *= nan;
    EXPECT_THROW(WorkspaceMapping{placement}, std::invalid_argument);
    placement = {};
    placement.offset.x() = nan;
    EXPECT_THROW(WorkspaceMapping{placement}, std::invalid_argument);
}
} // namespace
} // namespace ode_predictive_space::haptics
