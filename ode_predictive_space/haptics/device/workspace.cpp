#include "ode_predictive_space/haptics/workspace.h"

#include "ode_predictive_space/haptics/device/check_argument.h"

#include <cmath>

namespace ode_predictive_space::haptics
{
Quaternion WorkspacePlacement::z_up()
{
    // An exact quarter turn about x.
    const double half = std::sqrt(0.5);
    return Quaternion(half, half, 0, 0);
}

WorkspacePlacement WorkspacePlacement::covering(const Eigen::AlignedBox3d &scene, const Eigen::AlignedBox3d &device,
                                                const Quaternion &rotation)
{
    for (const Eigen::AlignedBox3d &box : {scene, device})
        if (box.isEmpty() || !box.min().allFinite() || !box.max().allFinite())
            throw std::invalid_argument("a workspace must be a finite box that is not empty");
    if (device.sizes().minCoeff() <= 0)
        throw std::invalid_argument("the workspace of the device must not be flat");

    if (scene.sizes().maxCoeff() <= 0)
        throw std::invalid_argument("the scene must be more than a point");

    // The extent of the scene along the axes of the device.
    const Vector3 half = scene.sizes() / 2;
    const Vector3 reach = rotation.conjugate().toRotationMatrix().cwiseAbs() * half;

    WorkspacePlacement placement;
    placement.scale = reach.cwiseQuotient(device.sizes() / 2).maxCoeff();
    placement.rotation = rotation;
    placement.offset = scene.center() - placement.scale * (rotation * device.center());
    return placement;
}

namespace
{
void check(const WorkspacePlacement &placement)
{
    check_positive(placement.scale, "scale of a workspace");
    check_positive(placement.force_scale, "force scale of a workspace");
    if (!placement.offset.allFinite())
        throw std::invalid_argument("the offset of a workspace must be finite");
    if (!(std::abs(placement.rotation.norm() - 1) <= 1e-6))
        throw std::invalid_argument("the rotation of a workspace must be a quaternion of length 1");
}
} // namespace

WorkspaceMapping::WorkspaceMapping(const WorkspacePlacement &placement)
{
    check(placement);
    base_ = placement;
    base_.rotation.normalize();
    placement_ = base_;
}

void WorkspaceMapping::move_base(const WorkspacePlacement &placement, const BaseMotion &motion)
{
    check(placement);
    if (placement.scale != base_.scale || placement.force_scale != base_.force_scale)
        throw std::invalid_argument("the scales of a workspace cannot change while its base moves");
    if (!motion.velocity.allFinite() || !motion.spin.allFinite())
        throw std::invalid_argument("the motion of a workspace's base must be finite");

    const Quaternion rotation = placement.rotation.normalized();
    const Quaternion turn = rotation * base_.rotation.conjugate();
    const auto carried = [&](const Vector3 &point) -> Vector3 {
        return placement.offset + turn * (point - base_.offset);
    };
    placement_.offset = carried(placement_.offset);
    placement_.rotation = rotation;
    held_.position = carried(held_.position);
    held_.orientation = (turn * held_.orientation).normalized();
    base_.offset = placement.offset;
    base_.rotation = rotation;
    motion_ = motion;
}

ToolState WorkspaceMapping::moved_with_base(ToolState tool) const
{
    tool.linear_velocity += motion_.velocity + motion_.spin.cross(tool.position - base_.offset);
    tool.angular_velocity += motion_.spin;
    return tool;
}

void WorkspaceMapping::clutch(bool held, const DeviceState &device)
{
    if (held && !clutched_)
    {
        held_ = to_scene(device);
        held_.linear_velocity.setZero();
        held_.angular_velocity.setZero();
    }
    else if (!held && clutched_)
    {
        placement_.offset = held_.position - placement_.scale * (placement_.rotation * device.position);
        grip_ = ((placement_.rotation * device.orientation).conjugate() * held_.orientation).normalized();
    }
    clutched_ = held;
}

ToolState WorkspaceMapping::to_scene(const DeviceState &device) const
{
    if (clutched_)
        return moved_with_base(held_);
    const WorkspacePlacement &p = placement_;
    ToolState tool;
    tool.position = p.offset + p.scale * (p.rotation * device.position);
    tool.orientation = p.rotation * device.orientation * grip_;
    tool.linear_velocity = p.scale * (p.rotation * device.linear_velocity);
    tool.angular_velocity = p.rotation * device.angular_velocity;
    return moved_with_base(tool);
}

Wrench WorkspaceMapping::to_device(const Wrench &scene) const
{
    Wrench wrench;
    if (clutched_)
        return wrench;
    const Quaternion back = placement_.rotation.conjugate();
    wrench.force = placement_.force_scale * (back * scene.force);
    wrench.torque = placement_.force_scale * (back * scene.torque);
    return wrench;
}
} // namespace ode_predictive_space::haptics
