// The command line of ode-predictive-run.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_RUN_OPTIONS_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_RUN_OPTIONS_H

#include <string>

namespace ode_predictive_space::preload
{
/// Ends the launcher with status 2, after a line on standard error.
[[noreturn]] __attribute__((format(printf, 1, 2))) void fail(const char *format, ...);

/// What the launcher itself is to do.
struct RunOptions
{
    char **command = nullptr;  ///< the program and its arguments: the end of argv
    bool watch = false;        ///< show live counters
    std::string report_folder; ///< for a page with plots; empty: none
    std::string record_file;   ///< the program is recorded there: for the user, or for the page; empty: it is not
};

/// Sets the environment variables that the other options stand for. Ends the launcher after --help and --version, and by fail() when an
/// option is wrong, a file cannot be written or no program is named.
RunOptions take_options(int argc, char **argv);
} // namespace ode_predictive_space::preload

#endif
