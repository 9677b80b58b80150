// Runs programs that die, each in a child process.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_CHILD_PROGRAM_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_CHILD_PROGRAM_H

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace ode_predictive_space::haptics
{
/// The exit status of a child whose program returned.
constexpr int returned = 99;

struct ProgramEnd
{
    int status = 0; ///< from waitpid()
    bool hung = false;
    std::string messages; ///< on its standard error

    bool exited_with(int code) const { return !hung && WIFEXITED(status) && WEXITSTATUS(status) == code; }
    bool died_of(int signal) const { return !hung && WIFSIGNALED(status) && WTERMSIG(status) == signal; }
    bool says(const std::string &part) const { return messages.find(part) != std::string::npos; }
};

inline void wait_for(pid_t child, ProgramEnd &end)
{
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (waitpid(child, &end.status, WNOHANG) == 0)
    {
        if (std::chrono::steady_clock::now() > deadline)
        {
            end.hung = true;
            kill(child, SIGKILL);
            waitpid(child, &end.status, 0);
            return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

inline ProgramEnd end_of(const std::function<void()> &program)
{
    const int messages = memfd_create("messages", 0);
    const pid_t child = fork();
    if (child == 0)
    {
        const rlimit no_core = {0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        dup2(messages, STDERR_FILENO);
        std::thread(program).join(); // nothing catches its exceptions, and nothing is unwound
        std::_Exit(returned);
    }
    ProgramEnd end;
    wait_for(child, end);
    end.messages.resize(static_cast<std::size_t>(lseek(messages, 0, SEEK_END)));
    if (pread(messages, end.messages.data(), end.messages.size(), 0) < 0)
        end.messages = "unreadable";
    close(messages);
    return end;
}
} // namespace ode_predictive_space::haptics

#endif
