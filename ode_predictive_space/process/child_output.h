#ifndef ODE_PREDICTIVE_SPACE_PROCESS_CHILD_OUTPUT_H
#define ODE_PREDICTIVE_SPACE_PROCESS_CHILD_OUTPUT_H

#include <functional>
#include <optional>
#include <string>

namespace ode_predictive_space::process
{
/// Runs another program and waits for its end.
///
/// @param become called in a child process with the writing end of a pipe, which is closed when another program begins. It makes
///               the pipe one of that program's files and becomes the program; when it returns, the child ends with status 127.
/// @return all that was written; none when there was no child, or its exit status was not 0.
std::optional<std::string> child_output(const std::function<void(int pipe)> &become);
} // namespace ode_predictive_space::process

#endif
