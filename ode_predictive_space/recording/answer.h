#ifndef ODE_PREDICTIVE_SPACE_RECORDING_ANSWER_H
#define ODE_PREDICTIVE_SPACE_RECORDING_ANSWER_H

#include "ode_predictive_space/recording/page.h"
#include "ode_predictive_space/recording/recording.h"

namespace ode_predictive_space::recording
{
/// What the program that was recorded would gain: replays it in its own kind of spaces and in predictive ones, by the clock.
///
/// No replay takes much longer than two seconds: all of them end where the first one did.
Answer answer_for(const Recording &recording);
} // namespace ode_predictive_space::recording

#endif
