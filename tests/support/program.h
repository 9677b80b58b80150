// Runs a program as a user does, and keeps its exit status and its output.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_PROGRAM_H
#define ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_PROGRAM_H

#include <cstdio>
#include <string>
#include <sys/wait.h>

namespace ode_predictive_space
{
struct Outcome
{
    int status = -1;    ///< exit status; -1 if it did not start or a signal ended it
    std::string output; ///< standard output and standard error
};

inline Outcome run(const std::string &program, const std::string &arguments)
{
    Outcome outcome;
    const std::string command = "'" + program + "' " + arguments + " 2>&1";
    FILE *pipe = popen(command.c_str(), "r");
    if (pipe == nullptr)
    {
        return outcome;
    }
    char buffer[4096];
    for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
    {
        outcome.output.append(buffer, got);
    }
    const int status = pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

inline bool contains(const std::string &text, const std::string &part)
{
    return text.find(part) != std::string::npos;
}

inline int count_of(const std::string &part, const std::string &text)
{
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}
} // namespace ode_predictive_space

#endif
