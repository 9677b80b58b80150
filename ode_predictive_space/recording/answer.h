#ifndef ODE_PREDICTIVE_SPACE_RECORDING_ANSWER_H
#define ODE_PREDICTIVE_SPACE_RECORDING_ANSWER_H

#include "ode_predictive_space/recording/page.h"
#include "ode_predictive_space/recording/recording.h"

namespace ode_predictive_space::recording
{
/// Replays a recording in spaces of all kinds. No replay takes much longer than two seconds: all end where the first one did.
Answer answer_for(const Recording &recording);
} // namespace ode_predictive_space::recording

#endif
