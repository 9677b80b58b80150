#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_COMMAND_LINE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_COMMAND_LINE_H

#include <CLI/CLI.hpp>

namespace ode_predictive_space::worlds
{
/// @return the exit status: 0 for help, 2 for a command line that cannot be understood.
inline int end_of_parsing(const CLI::App &app, const CLI::ParseError &end)
{
    return app.exit(end) == 0 ? 0 : 2;
}
} // namespace ode_predictive_space::worlds

#endif
