#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_GAIN_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_GAIN_H

#include <string>

#include "ode_predictive_space/report/answer.h"

namespace ode_predictive_space::preload
{
/// What the recorded program would gain, from replays of its recording. When it is not known, the answer says so and why.
report::Answer gain_of(const std::string &recording);
} // namespace ode_predictive_space::preload

#endif
