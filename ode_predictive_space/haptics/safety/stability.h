// What can be rendered stably, where there is no time for words.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_STABILITY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_STABILITY_H

#include "ode_predictive_space/haptics/safety.h"

namespace ode_predictive_space::haptics
{
/// As check_stability() without words, for where something has to be rendered: neither allocates nor throws. Damping that nothing would make passive
/// becomes none.
///
/// @return what may be rendered; its stiffness and damping are those asked for, or less.
Rendering renderable(const Capabilities &capabilities, const Rendering &rendering) noexcept;
} // namespace ode_predictive_space::haptics

#endif
