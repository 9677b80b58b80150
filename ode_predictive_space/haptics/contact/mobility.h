// The response of a body to a push.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MOBILITY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MOBILITY_H

#include "ode_predictive_space/haptics/device.h"

#include <ode/common.h>

namespace ode_predictive_space::haptics
{
/// Inverse inertia of a body; zero if no push moves it.
struct Mobility
{
    double inverse_mass = 0;                                   ///< 1/kg
    Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero(); ///< 1/(kg m^2); the scene's frame

    /// Mobility of a free body; zero for a kinematic one and for 0. Joints only reduce it, so this is an upper bound.
    static Mobility of(dBodyID body);

    bool is_zero() const { return inverse_mass == 0; }

    /// 1/kg; speed of a place of the body along a direction per impulse along it.
    /// @param arm m; from the centre of mass. @param direction of length 1.
    double along(const Vector3 &arm, const Vector3 &direction) const
    {
        const Vector3 moment = arm.cross(direction);
        return inverse_mass + moment.dot(inverse_inertia * moment);
    }
};
} // namespace ode_predictive_space::haptics

#endif
