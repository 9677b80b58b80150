#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_RUN_COMMAND_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_RUN_COMMAND_H

#include <string>
#include <vector>

namespace ode_predictive_space::preload
{
/// The command line of `ode-predictive run`. An option that is not given is empty.
struct RunOptions
{
    std::string spaces;    ///< hash, quadtree, sap, simple, all, none; several separated by commas
    std::string proximity; ///< box, sphere, shape
    std::string stats;     ///< a file, or `to_standard_error`
    std::string trace_file, record_file, record_limit, report_folder;
    std::vector<std::string> command; ///< the program and its arguments

    static constexpr const char *to_standard_error = "true"; ///< of statistics
};

/// Runs the program with the preload in place of this one; with a report, waits for it, writes the page and ends as it ended.
/// @throws std::runtime_error for options that cannot be carried out, before the program runs.
[[noreturn]] void run(RunOptions options);
} // namespace ode_predictive_space::preload

#endif
