// A program that is run beside this one and fed through its standard input.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_CHILD_PROCESS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_CHILD_PROCESS_H

#include <cstdio>
#include <string>
#include <sys/types.h>
#include <vector>

namespace ode_predictive_space::benchmarks
{
/// Its standard output is thrown away; its standard error is ours.
class ChildProcess
{
public:
    /// @param arguments the first one is the program, looked for in PATH.
    /// @param environment all of it, as NAME=VALUE.
    /// @throws std::system_error when it cannot be started: with ENOENT when it is not there.
    ChildProcess(const std::vector<std::string> &arguments, const std::vector<std::string> &environment);

    /// Closes its input and waits for its end.
    ~ChildProcess();
    ChildProcess(const ChildProcess &) = delete;
    ChildProcess &operator=(const ChildProcess &) = delete;

    /// Its standard input. A write to a process that has ended fails.
    std::FILE *input() { return input_; }

    /// Close its input and wait for its end.
    ///
    /// @return whether its exit status was 0.
    bool finish();

private:
    void close_input();

    std::FILE *input_ = nullptr;
    pid_t process_ = -1; ///< < 0: has ended
};
} // namespace ode_predictive_space::benchmarks

#endif
