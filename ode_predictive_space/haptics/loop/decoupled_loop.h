// The loop of two threads: the caller's steps the scene, another one is the servo.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DECOUPLED_LOOP_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DECOUPLED_LOOP_H

#include "ode_predictive_space/haptics/loop/loop_parts.h"

namespace ode_predictive_space::haptics
{
/// Until the duration is over or the loop must end. @throws what the law throws in the servo's thread, too.
void run_decoupled(LoopParts &parts, const SceneWork &work);
} // namespace ode_predictive_space::haptics

#endif
