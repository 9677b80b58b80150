// Benchmarks of the predictive space beside ODE's own. Every claim is a ratio measured in one run, with the same motion.

#include "demos/runs/check_writable.h"
#include "demos/runs/command_line.h"
#include "demos/runs/narrow_output.h"
#include "demos/runs/result_records.h"
#include "demos/runs/spaces.h"
#include "tests/benchmarks/command.h"
#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/which_ode.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

namespace
{
using namespace ode_predictive_space::benchmarks;

ExitStatus run(Command &command, const Options &options)
{
    Findings findings;
    try
    {
        if (!options.json_file.empty())
        {
            ode_predictive_space::worlds::check_writable(options.json_file);
        }
        const ode_predictive_space::worlds::OdeSession ode;
        std::cout << which_ode() << "\n\n" << std::flush;
        command.measure(options, findings);
        findings.print(std::cout);
        if (!options.json_file.empty())
        {
            ode_predictive_space::worlds::write_json(options.json_file, findings.records());
        }
    }
    catch (const std::exception &failure)
    {
        std::cerr << "predictive_bench: " << failure.what() << '\n';
        findings.fail(exit_failed);
    }
    return findings.status();
}

int run_as_asked(int argc, char **argv)
{
    CLI::App app("What the predictive space, ODE's own spaces and others cost, side by side, with the same motion.\n"
                 "Exit status: 0, or 1 when contenders did not report the same pairs, or 2 when something failed\n"
                 "or the command line is wrong.");
    app.require_subcommand(1);
    Options options;
    const Commands commands = make_commands();
    std::vector<CLI::App *> subcommands;
    for (const auto &command : commands)
    {
        subcommands.push_back(app.add_subcommand(command->name(), command->description()));
        declare_options(*subcommands.back(), options);
        command->add_options(*subcommands.back());
    }
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError &end)
    {
        return ode_predictive_space::worlds::end_of_parsing(app, end);
    }
    for (std::size_t i = 0; i < commands.size(); ++i)
    {
        if (subcommands[i]->parsed())
        {
            return run(*commands[i], options);
        }
    }
    return exit_failed;
}
} // namespace

int main(int argc, char **argv)
{
    ode_predictive_space::worlds::NarrowOutput results;
    const int status = run_as_asked(argc, argv);
    if (!results.finish())
    {
        std::cerr << "predictive_bench: standard output cannot be written\n";
        return exit_failed;
    }
    return status;
}
