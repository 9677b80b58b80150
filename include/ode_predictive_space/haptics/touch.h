// What the probe touches, as force laws see it.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_H

#include "ode_predictive_space/haptics/device.h"
#include "ode_predictive_space/haptics/material.h"

#include <optional>
#include <vector>

namespace ode_predictive_space::haptics
{
/// A contact of the probe with an object, in the scene's frame, SI units: a plane of it that holds off the probe, or nearly. An
/// object may have several at once: the floor and the walls of a channel.
struct Touch
{
    Vector3 point = Vector3::Zero();            ///< m
    Vector3 normal = Vector3::UnitZ();          ///< of the touched surface, of length 1, towards the probe
    double depth = 0;                           ///< m, >= 0; how far the probe is beyond the surface
    Vector3 surface_velocity = Vector3::Zero(); ///< m/s; of the touched object at the point
    std::uintptr_t object = 0; ///< which object: the same from tick to tick, different for different ones
    unsigned feature = 0; ///< which plane of the object: the same from tick to tick, different for those of one object
    bool from_entry_side = false; ///< the normal is that of the side by which the probe came, however deep it is by now
    std::optional<Material>
        material; ///< nothing: the force law's own. A renderer fills it in with what the device can render
};

/// What the touches are of several objects at once.
enum class TouchView
{
    each_object_alone, ///< each object's, as if there were no other
    all_together       ///< those that hold off the probe from all objects at once
};

/// The probe, in the scene's frame, SI units.
struct ToolState
{
    Vector3 position = Vector3::Zero();              ///< m
    Quaternion orientation = Quaternion::Identity(); ///< of length 1
    Vector3 linear_velocity = Vector3::Zero();       ///< m/s
    Vector3 angular_velocity = Vector3::Zero();      ///< rad/s
};

/// The forces on the probe, in N, one per touch and in their order: what each of the objects gets is minus that.
using TouchForces = std::vector<Vector3>;
} // namespace ode_predictive_space::haptics

#endif
