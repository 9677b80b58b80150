// Vectors and tensors between ODE and the library.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_ODE_VECTOR_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_ODE_VECTOR_H

#include "ode_predictive_space/haptics/device.h"

#include <ode/mass.h>
#include <ode/objects.h>

namespace ode_predictive_space::haptics
{
inline Vector3 from_ode(const dReal *v)
{
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

/// kg m^2; in the body's frame.
inline Eigen::Matrix3d inertia_of(const dMass &mass)
{
    using Rows = Eigen::Matrix<dReal, 3, 4, Eigen::RowMajor>; // ODE leaves a fourth column free
    return Eigen::Map<const Rows>(mass.I).leftCols<3>().cast<double>();
}

/// Calls a function of ODE that takes an object and three coordinates, such as dBodyAddForce().
template <typename Object>
void call_ode(void (*function)(Object, dReal, dReal, dReal), Object object, const Vector3 &vector)
{
    function(object, static_cast<dReal>(vector.x()), static_cast<dReal>(vector.y()), static_cast<dReal>(vector.z()));
}

template <typename Object> void call_ode(void (*function)(Object, const dReal *), Object object, const Quaternion &turn)
{
    const dQuaternion quaternion = {static_cast<dReal>(turn.w()), static_cast<dReal>(turn.x()),
                                    static_cast<dReal>(turn.y()), static_cast<dReal>(turn.z())};
    function(object, quaternion);
}

/// Adds a force and a moment about the centre of mass, and enables a disabled body.
inline void push_body(dBodyID body, const Vector3 &force, const Vector3 &moment)
{
    dBodyEnable(body);
    call_ode(&dBodyAddForce, body, force);
    call_ode(&dBodyAddTorque, body, moment);
}
} // namespace ode_predictive_space::haptics

#endif
