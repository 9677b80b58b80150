// The command line of ode-predictive-run.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_RUN_OPTIONS_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_RUN_OPTIONS_H

namespace ode_predictive_space::preload
{
/// Ends the launcher with status 2, after a line on standard error.
[[noreturn]] __attribute__((format(printf, 1, 2))) void fail(const char *format, ...);

/// Sets the environment variables that the options stand for. Ends the launcher after --help and --version, and by fail() when an
/// option is wrong or no program is named.
///
/// @return the program and its arguments: the end of argv.
char **take_options(int argc, char **argv);
} // namespace ode_predictive_space::preload

#endif
