// What ODE gives as three numbers.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_ODE_VECTOR_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_ODE_VECTOR_H

#include "ode_predictive_space/haptics/device.h"

#include <ode/common.h>

namespace ode_predictive_space::haptics
{
inline Vector3 from_ode(const dReal *v)
{
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}
} // namespace ode_predictive_space::haptics

#endif
