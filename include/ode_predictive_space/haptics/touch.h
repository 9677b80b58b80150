// What the probe touches, as force laws see it.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_H

#include "ode_predictive_space/haptics/device.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// The deepest contact of the probe with one object, in the scene's frame, SI units.
struct Touch
{
    Vector3 point = Vector3::Zero();            ///< m
    Vector3 normal = Vector3::UnitZ();          ///< of the touched surface, of length 1, towards the probe
    double depth = 0;                           ///< m, >= 0; how far the probe is beyond the surface
    Vector3 surface_velocity = Vector3::Zero(); ///< m/s; of the touched object at the point
    std::uintptr_t object = 0; ///< which object: the same from tick to tick, different for different ones
};

/// The probe, in the scene's frame, SI units.
struct ToolState
{
    Vector3 position = Vector3::Zero(); ///< m
    Quaternion orientation = Quaternion::Identity();
    Vector3 linear_velocity = Vector3::Zero();  ///< m/s
    Vector3 angular_velocity = Vector3::Zero(); ///< rad/s
};

/// The forces on the probe, in N, one per touch and in their order: what each of the objects gets is minus that.
using TouchForces = std::vector<Vector3>;
} // namespace ode_predictive_space::haptics

#endif
