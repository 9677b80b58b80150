// Validation of materials, and the transition from one to another.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MATERIAL_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MATERIAL_H

#include "ode_predictive_space/haptics/touch.h"

namespace ode_predictive_space::haptics
{
/// @throws std::invalid_argument that names the property which is negative or not finite.
void check(const Material &material);

bool is_valid(const Material &material);

/// A step towards another material, so that the force does not jump: a property changes by at most its larger value in 20 ms.
Material blended(const Material &from, const Material &to, double dt);
} // namespace ode_predictive_space::haptics

#endif
