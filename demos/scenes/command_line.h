// What the programs with a command line share: how they end, what they check first, how wide they print.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_COMMAND_LINE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_COMMAND_LINE_H

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace ode_predictive_space::scenes
{
/// Prints the help that was asked for, or what is wrong with the command line.
///
/// @return the exit status: 0 for help, 2 for a command line that cannot be understood.
inline int end_of_parsing(const CLI::App &app, const CLI::ParseError &end)
{
    return app.exit(end) == 0 ? 0 : 2;
}

/// Checks before a run that its results can be written afterwards. The file is left as it was.
///
/// @throws std::runtime_error when it cannot be written.
inline void check_writable(const std::string &file)
{
    const bool existed = std::filesystem::exists(file);
    if (!std::ofstream(file, std::ios::app))
    {
        throw std::runtime_error("cannot write " + file);
    }
    if (!existed)
    {
        std::filesystem::remove(file);
    }
}
} // namespace ode_predictive_space::scenes

#endif
