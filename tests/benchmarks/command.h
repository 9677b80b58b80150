// A subcommand of predictive_bench.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_COMMAND_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_COMMAND_H

#include <CLI/CLI.hpp>
#include <memory>

namespace ode_predictive_space::benchmarks
{
/// What the program returns.
enum ExitStatus
{
    exit_ok = 0,
    exit_wrong_pairs = 1, ///< spaces that must agree did not, or the predictive space failed its check
    exit_failed = 2       ///< the benchmark could not be run
};

class Command
{
public:
    virtual ~Command() = default;

    /// Add the subcommand and its options; keeps what is given on the command line.
    virtual void declare(CLI::App &program) = 0;

    /// Whether it is the one that was asked for.
    virtual bool chosen() const = 0;

    /// @throws std::exception when it cannot be run.
    virtual ExitStatus run() = 0;
};

/// `scene NAME`: one scene in several spaces.
std::unique_ptr<Command> make_scene_command();
} // namespace ode_predictive_space::benchmarks

#endif
