// How a body answers a push.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MOBILITY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MOBILITY_H

#include "ode_predictive_space/haptics/device.h"

#include <ode/common.h>

namespace ode_predictive_space::haptics
{
/// Zero for what no push moves.
struct Mobility
{
    double inverse_mass = 0;                                   ///< 1/kg
    Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero(); ///< 1/(kg m^2); the scene's frame

    /// Of a free body; zero for a kinematic one, and for none. Joints only take mobility away, so this is the most that there can be.
    static Mobility of(dBodyID body);

    bool is_zero() const { return inverse_mass == 0; }

    /// 1/kg; how fast a place of the body moves along a direction after a push along it of 1 N s.
    ///
    /// @param arm m; from the centre of mass. @param direction of length 1.
    double along(const Vector3 &arm, const Vector3 &direction) const
    {
        const Vector3 moment = arm.cross(direction);
        return inverse_mass + moment.dot(inverse_inertia * moment);
    }
};
} // namespace ode_predictive_space::haptics

#endif
