#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_SURVIVORS_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_SURVIVORS_H

#include <string>
#include <vector>

#include "ode_predictive_space/preload/counts_file.h"

namespace ode_predictive_space::preload
{
bool is_alive(int process);

/// The processes that have a setting, "NAME=value", in the environment that they began with, but for this one. Each is described by
/// its name and process id.
std::vector<std::string> processes_with(const std::string &setting);

/// The processes that run with the launcher's environment, and those that count and run: after the program's end, those that
/// outlive it. Each is described by its name and process id.
std::vector<std::string> survivors(CountsFile &counts);

/// "program (process 7), program (process 8) and 5 more"; at most ten are named.
std::string list_of(const std::vector<std::string> &processes);
} // namespace ode_predictive_space::preload

#endif
