// Benchmarks of the predictive space beside ODE's own. Every claim is a ratio measured in one run, with the same motion.

#include "tests/benchmarks/command.h"

#include <exception>
#include <iostream>
#include <vector>

int main(int argc, char **argv)
{
    using namespace ode_predictive_space::benchmarks;
    CLI::App app("What the predictive space and ODE's own spaces cost, side by side, with the same motion.\n"
                 "Exit status: 0, or 1 when spaces did not report the same pairs, or 2 when something failed.");
    app.require_subcommand(1);
    std::vector<std::unique_ptr<Command>> commands;
    commands.push_back(make_scene_command());
    for (const auto &command : commands)
    {
        command->declare(app);
    }
    CLI11_PARSE(app, argc, argv);
    try
    {
        for (const auto &command : commands)
        {
            if (command->chosen())
            {
                return command->run();
            }
        }
    }
    catch (const std::exception &failure)
    {
        std::cerr << "predictive_bench: " << failure.what() << '\n';
    }
    return exit_failed;
}
