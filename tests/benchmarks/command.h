// A subcommand of predictive_bench.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_COMMAND_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_COMMAND_H

#include "tests/benchmarks/findings.h"
#include "tests/benchmarks/options.h"

#include <memory>

namespace ode_predictive_space::benchmarks
{
/// The options that all subcommands have are declared by the program; ODE is ready when measure() is called.
class Command
{
public:
    virtual ~Command() = default;

    virtual std::string name() const = 0;
    virtual std::string description() const = 0;

    /// Add options that no other subcommand has. Not called when `all` calls measure().
    virtual void add_options(CLI::App &) {}

    /// Measure, print tables to the standard output, and add to the findings. `all` calls this, too, with neither n nor
    /// ticks nor spaces given: it is then to measure what the requirements ask of it.
    ///
    /// @throws std::exception when it cannot be done.
    virtual void measure(const Options &options, Findings &findings) = 0;
};

using Commands = std::vector<std::unique_ptr<Command>>;
} // namespace ode_predictive_space::benchmarks

#endif
