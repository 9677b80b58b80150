// The mapping between the frames of a device and the scene.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_WORKSPACE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_WORKSPACE_H

#include "ode_predictive_space/haptics/device.h"

namespace ode_predictive_space::haptics
{
/// Placement of a device's workspace in the scene.
struct WorkspacePlacement
{
    double scale = 1;                             ///< > 0; metres of the scene per metre of the device
    Quaternion rotation = Quaternion::Identity(); ///< from the device's axes to the scene's
    Vector3 offset = Vector3::Zero();             ///< m; the device's origin in the scene
    double force_scale = 1;                       ///< > 0; newtons at the device per newton in the scene

    /// The rotation for a scene whose z axis points up: the device's y (up) becomes z, its -z (away from the person) y.
    static Quaternion z_up();

    /// The placement with the smallest scale at which a scene's box (m) is within reach, with equal centres.
    /// @throws std::invalid_argument for an empty or infinite box, a flat device or a scene of a point.
    static WorkspacePlacement covering(const Eigen::AlignedBox3d &scene, const Eigen::AlignedBox3d &device,
                                       const Quaternion &rotation = Quaternion::Identity());
};

/// Motion of a device's base in the scene: on a vehicle, a lift, a tracked platform, or following the tool.
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
/// By default, forces are not scaled. A wall of k N/m in the scene then has scale * k N/m in the hand, because the tool
/// moves scale times as far: see stiffness_at_device().
///
/// The clutch: while it is held, the device moves without force, and the tool stays in place. After its release the
/// tool continues from there, with a changed offset and grip (R q becomes R q g).
class WorkspaceMapping
{
public:
    /// @throws std::invalid_argument for values that are not finite, a scale <= 0, or a rotation not of length 1
    ///         (1e-6).
    explicit WorkspaceMapping(const WorkspacePlacement &placement = {});

    /// Moves the base with the placement, the held tool and the clutch's offset as a rigid body. Velocities in the
    /// scene include the base's motion.
    ///
    /// @param placement of the base, without the clutch.
    /// @throws std::invalid_argument as the constructor does, and for a changed scale, with which the tool would jump.
    void move_base(const WorkspacePlacement &placement, const BaseMotion &motion);

    /// The placement of the base, without the offset of the clutch.
    const WorkspacePlacement &base() const { return base_; }

    /// Updates the clutch in each tick, before the other calls. @param device the state in this tick.
    void clutch(bool held, const DeviceState &device);
    /// Whether the clutch is held.
    bool clutched() const { return clutched_; }

    /// The tool in the scene for a state of the device; constant while the clutch is held.
    ToolState to_scene(const DeviceState &device) const;

    /// The wrench in the device's frame; zero while the clutch is held.
    Wrench to_device(const Wrench &scene) const;

    /// N/m (or N s/m); a stiffness (or damping) of the scene at the device, for check_stability().
    double stiffness_at_device(double stiffness) const { return stiffness * placement_.scale * placement_.force_scale; }
    /// The inverse of stiffness_at_device().
    double stiffness_in_scene(double stiffness) const
    {
        return stiffness / (placement_.scale * placement_.force_scale);
    }

    /// The present placement; the clutch changes its offset.
    const WorkspacePlacement &placement() const { return placement_; }

private:
    ToolState moved_with_base(ToolState tool) const;

    WorkspacePlacement base_;                  // of the program
    BaseMotion motion_;                        // of the base
    WorkspacePlacement placement_;             // base_, moved by the clutch
    Quaternion grip_ = Quaternion::Identity(); // the tool's orientation in the handle's frame
    bool clutched_ = false;
    ToolState held_; // the held tool; valid while the clutch is held
};
} // namespace ode_predictive_space::haptics

#endif
