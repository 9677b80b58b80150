#ifndef ODE_PREDICTIVE_SPACE_REPLAY_ANSWER_H
#define ODE_PREDICTIVE_SPACE_REPLAY_ANSWER_H

#include <string>

#include "ode_predictive_space/history/recording.h"
#include "ode_predictive_space/report/answer.h"

namespace ode_predictive_space::replay
{
/// What the program that was recorded would gain: replays it in its own kind of spaces and in predictive ones, by the clock.
///
/// No replay takes much longer than two seconds: all of them end where the first one did.
report::Answer answer_for(const history::Recording &recording);
} // namespace ode_predictive_space::replay

#endif
