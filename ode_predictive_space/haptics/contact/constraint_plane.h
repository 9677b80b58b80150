// A half-space that the tool's proxy must not enter.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONSTRAINT_PLANE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONSTRAINT_PLANE_H

#include "ode_predictive_space/haptics/device.h"

namespace ode_predictive_space::haptics
{
/// What a touch forbids to the proxy: all behind a plane.
struct ConstraintPlane
{
    Vector3 normal = Vector3::UnitZ(); ///< of length 1, towards where the proxy may be
    double depth = 0;                  ///< m; how far the tool is behind it
    double share = 0;                  ///< m, >= 0; how far it lifts the proxy off the tool, along its normal
};
} // namespace ode_predictive_space::haptics

#endif
