// The single-threaded loop: read, collide, force, step.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_COUPLED_LOOP_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_COUPLED_LOOP_H

#include "ode_predictive_space/haptics/loop/loop_parts.h"

namespace ode_predictive_space::haptics
{
/// Until the duration is over or the loop must end.
void run_coupled(LoopParts &parts, const SceneWork &work);
} // namespace ode_predictive_space::haptics

#endif
