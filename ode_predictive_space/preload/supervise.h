// A program that is run by another one which outlives it.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_SUPERVISE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_SUPERVISE_H

namespace ode_predictive_space::preload
{
/// Puts a program in the place of this one. When it cannot be started, ends this one with status 126 or 127.
[[noreturn]] void become(char **command);

/// Runs a program and waits for its end. Signals that others send to this process are passed on; those that the terminal sends
/// reach the program by themselves. When the program is stopped, so is this process. When this process is killed, so is the
/// program. To be called once, by a process with one thread: all signals remain blocked.
///
/// @param file stays open; standard error too. Standard input, output and all other files of this process are closed, so that
/// the program alone decides when the other end of a pipe sees its end.
/// @return its status, as from waitpid().
int run_and_wait(char **command, int file);

/// Ends this process as the other one ended: with its exit status, or by its signal, but without a second core file. Exit status 0
/// becomes 2 unless all output was written.
[[noreturn]] void end_like(int status, bool all_written);
} // namespace ode_predictive_space::preload

#endif
