// How easily a body moves when it is pushed.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MOBILITY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MOBILITY_H

#include "ode_predictive_space/haptics/device.h"

namespace ode_predictive_space::haptics
{
/// What an impulse does to a touched body: the scene's frame, SI units. Things without a body, and kinematic bodies, have no mobility.
struct Mobility
{
    double inverse_mass = 0;                                   ///< 1/kg; 0: nothing moves it
    Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero(); ///< 1/(kg m^2)
    Vector3 centre = Vector3::Zero();                          ///< m; of mass
    double yield =
        1; ///< 0 to 1; how much of a free body's motion the scene lets it have at the touch: 0 when it is held

    /// m/s; the change of velocity that an impulse (N s) at one point gives to another point of the free body.
    Vector3 response(const Vector3 &impulse, const Vector3 &at, const Vector3 &point) const
    {
        const Vector3 spin = inverse_inertia * (at - centre).cross(impulse);
        return inverse_mass * impulse + spin.cross(point - centre);
    }
};
} // namespace ode_predictive_space::haptics

#endif
