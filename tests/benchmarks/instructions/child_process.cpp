#include "tests/benchmarks/instructions/child_process.h"

#include <array>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
/// As C functions want them: pointers into the strings, with a null pointer at the end.
std::vector<char *> pointers_to(const std::vector<std::string> &strings)
{
    std::vector<char *> pointers;
    for (const std::string &string : strings)
    {
        pointers.push_back(const_cast<char *>(string.c_str()));
    }
    pointers.push_back(nullptr);
    return pointers;
}

void check(int error, const std::string &what)
{
    if (error != 0)
    {
        throw std::system_error(error, std::generic_category(), what);
    }
}

/// A pipe that other programs do not inherit.
std::array<int, 2> open_pipe()
{
    std::array<int, 2> ends{};
    check(pipe2(ends.data(), O_CLOEXEC) == 0 ? 0 : errno, "a pipe");
    return ends;
}
} // namespace

ChildProcess::ChildProcess(const std::vector<std::string> &arguments, const std::vector<std::string> &environment)
{
    std::signal(SIGPIPE, SIG_IGN); // a write to a process that has ended then returns an error
    const std::array<int, 2> ends = open_pipe();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const int error = posix_spawnp(&process_, arguments.front().c_str(), &actions, nullptr,
                                   pointers_to(arguments).data(), pointers_to(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    if (error != 0)
    {
        process_ = -1;
        close(ends[1]);
    }
    check(error, arguments.front());
    input_ = fdopen(ends[1], "w");
}

ChildProcess::~ChildProcess()
{
    finish();
}

void ChildProcess::close_input()
{
    if (input_ != nullptr)
    {
        std::fclose(input_);
        input_ = nullptr;
    }
}

bool ChildProcess::finish()
{
    close_input();
    int status = -1;
    if (process_ > 0)
    {
        waitpid(process_, &status, 0);
        process_ = -1;
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
} // namespace ode_predictive_space::benchmarks
