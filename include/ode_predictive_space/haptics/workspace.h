// Between a device's frame and the scene's.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_WORKSPACE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_WORKSPACE_H

#include "ode_predictive_space/haptics/device.h"

namespace ode_predictive_space::haptics
{
/// How a device's workspace lies in the scene.
struct WorkspacePlacement
{
    double scale = 1;                             ///< > 0; metres of the scene per metre of the device
    Quaternion rotation = Quaternion::Identity(); ///< from the device's axes to the scene's
    Vector3 offset = Vector3::Zero();             ///< m; where in the scene the device's origin is
    double force_scale = 1;                       ///< > 0; newtons at the device per newton in the scene

    /// The rotation for a scene whose z axis points up, as in ODE's demos: the device's y (up) becomes z, its -z (away from the
    /// person) becomes y, x stays.
    static Quaternion z_up();

    /// The smallest scale at which all of a scene's box (m) is within reach, both centres upon each other.
    /// @throws std::invalid_argument when a box is empty or not finite, the device's is flat, or the scene's a point.
    static WorkspacePlacement covering(const Eigen::AlignedBox3d &scene, const Eigen::AlignedBox3d &device,
                                       const Quaternion &rotation = Quaternion::Identity());
};

/// How a device's base moves in the scene: that of a vehicle, a lift, a tracked platform or a workspace that follows the tool.
struct BaseMotion
{
    Vector3 velocity = Vector3::Zero(); ///< m/s; of the device's origin
    Vector3 spin = Vector3::Zero();     ///< rad/s
};

/// Maps a device's states to the scene, and the scene's forces to the device. Neither allocates nor locks.
///
///     position     offset + scale R p
///     orientation  R q
///     velocities   scale R v,  R omega
///     wrench       force_scale R^-1 (force, torque)
///
/// Forces are not scaled by default: what is 1 N in the scene is 1 N in the hand. A wall of k N/m in the scene then feels like
/// scale * k N/m, as the tool goes scale times as deep: see stiffness_at_device().
///
/// The clutch: while it is held, the device moves freely, without force, and the tool stays where it is. When it is released, the
/// tool moves on from there; the offset has changed, and the way the tool lies in the hand (R q becomes R q g). Speeds do not jump,
/// either, except to 0 and back.
class WorkspaceMapping
{
public:
    /// @throws std::invalid_argument when something is not finite, a scale not > 0, or the rotation not of length 1 (1e-6).
    explicit WorkspaceMapping(const WorkspacePlacement &placement = {});

    /// The base has moved: all that was placed by it goes along as a rigid body, the held tool and the clutch's offset too. Speeds in the
    /// scene have the base's motion in them.
    ///
    /// @param placement where the base is, as the program sees it: the clutch does not change it.
    /// @throws std::invalid_argument as the constructor does, and when a scale differs from that of before: the tool would jump.
    void move_base(const WorkspacePlacement &placement, const BaseMotion &motion);

    /// The placement of the base, without the offset of the clutch.
    const WorkspacePlacement &base() const { return base_; }

    /// Call in every tick before the others. @param device the state in this tick.
    void clutch(bool held, const DeviceState &device);
    /// Whether the clutch was held in the last call of clutch().
    bool clutched() const { return clutched_; }

    /// Where the tool is in the scene while the device is in this state; while the clutch is held, where it was at first.
    ToolState to_scene(const DeviceState &device) const;

    /// The inverse, as if the clutch were not held; buttons and time are left at zero.
    DeviceState to_device(const ToolState &tool) const;

    /// From the scene's frame to the device's; zero while the clutch is held.
    Wrench to_device(const Wrench &scene) const;

    /// N/m (or N s/m): what a stiffness (or a damping) of the scene is at the device. For check_stability().
    double stiffness_at_device(double stiffness) const { return stiffness * placement_.scale * placement_.force_scale; }
    /// The inverse.
    double stiffness_in_scene(double stiffness) const
    {
        return stiffness / (placement_.scale * placement_.force_scale);
    }

    /// As it is now: offset changes with the clutch.
    const WorkspacePlacement &placement() const { return placement_; }

private:
    ToolState moved_with_base(ToolState tool) const;

    WorkspacePlacement base_;                  // as the program gave it
    BaseMotion motion_;                        // of the base
    WorkspacePlacement placement_;             // base_, moved by the clutch
    Quaternion grip_ = Quaternion::Identity(); // the tool's orientation in the handle's frame
    bool clutched_ = false;
    ToolState held_; // where the tool stays; means nothing while the clutch is not held
};
} // namespace ode_predictive_space::haptics

#endif
