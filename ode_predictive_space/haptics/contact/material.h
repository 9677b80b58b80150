// Which materials there can be, and how one goes over into another.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MATERIAL_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MATERIAL_H

#include "ode_predictive_space/haptics/touch.h"

namespace ode_predictive_space::haptics
{
/// @throws std::invalid_argument that names the property which is negative or not finite.
void check(const Material &material);

/// The same, for where nothing may be thrown.
bool is_valid(const Material &material);

/// From one material towards another: where the probe goes from one surface to the next, or a material is changed, the force must not
/// jump. Each property goes by at most its larger value in 20 ms.
///
/// @param dt s.
Material blended(const Material &from, const Material &to, double dt);
} // namespace ode_predictive_space::haptics

#endif
