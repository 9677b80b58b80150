#include "ode_predictive_space/replay/instructions.h"

#include <cstdlib>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

#include "ode_predictive_space/process/child_output.h"

namespace ode_predictive_space::replay
{
namespace
{
std::string path_of_valgrind()
{
    const char *path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const std::string program = folder + "/valgrind"; access(program.c_str(), X_OK) == 0)
            return program;
    return "";
}

// Its standard error is wanted, its standard output is not. All functions are bound at its start, not when they are first called.
void become(const std::vector<std::string> &command, int error)
{
    dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDOUT_FILENO);
    dup2(error, STDERR_FILENO);
    setenv("LD_BIND_NOW", "1", 1);
    std::vector<char *> arguments;
    for (const std::string &word : command)
        arguments.push_back(const_cast<char *>(word.c_str()));
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
}
} // namespace

bool has_valgrind()
{
    return !path_of_valgrind().empty();
}

std::optional<std::uint64_t> collected(const std::string &output)
{
    const std::string label = "Collected : ";
    const std::size_t place = output.rfind(label);
    if (place == std::string::npos)
        return std::nullopt;
    const char *digits = output.c_str() + place + label.size();
    char *end = nullptr;
    const std::uint64_t number = std::strtoull(digits, &end, 10);
    return end == digits ? std::nullopt : std::optional<std::uint64_t>(number);
}

std::optional<std::uint64_t> instructions_of(const std::vector<std::string> &program)
{
    std::vector<std::string> command = {path_of_valgrind(),
                                        "--tool=callgrind",
                                        "--callgrind-out-file=/dev/null",
                                        "--toggle-collect=counted_changes",
                                        "--toggle-collect=counted_collide",
                                        "--toggle-collect=counted_end"};
    command.insert(command.end(), program.begin(), program.end());
    const auto output = process::child_output([&](int pipe) { become(command, pipe); });
    return output ? collected(*output) : std::nullopt;
}

std::optional<std::uint64_t> count_instructions(const std::string &replayer, const std::string &path, SpaceKind kind,
                                                const CountedEvents &events)
{
    std::vector<std::string> program = {replayer,
                                        "--counted",
                                        name_of(kind),
                                        "--from",
                                        std::to_string(events.from),
                                        "--to",
                                        std::to_string(events.to),
                                        "--every",
                                        std::to_string(events.every)};
    if (events.contacts)
        program.emplace_back("--contacts");
    if (events.whole_life)
        program.emplace_back("--whole-life");
    program.push_back(path);
    return instructions_of(program);
}
} // namespace ode_predictive_space::replay
