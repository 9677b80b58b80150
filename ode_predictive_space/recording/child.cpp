#include "ode_predictive_space/recording/child.h"

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <sys/wait.h>
#include <unistd.h>

#include <ode/error.h>

#include "ode_predictive_space/recording/printable.h"

namespace ode_predictive_space::recording
{
namespace
{
constexpr std::size_t longest_message = 500;
char *message_of_child;

void keep(const char *format, va_list arguments)
{
    std::vsnprintf(message_of_child, longest_message, format, arguments);
}

[[noreturn]] void end_child(int /*number*/, const char *format, va_list arguments)
{
    keep(format, arguments);
    _exit(1);
}

// A message does not end a collide. The last one is kept, as it may explain what follows.
void keep_message(int /*number*/, const char *format, va_list arguments)
{
    keep(format, arguments);
}

[[noreturn]] void run_child(const std::function<void()> &work)
{
    dSetDebugHandler(end_child);
    dSetErrorHandler(end_child);
    dSetMessageHandler(keep_message);
    try
    {
        work();
    }
    catch (const std::exception &failure)
    {
        std::snprintf(message_of_child, longest_message, "%s", failure.what());
        _exit(1);
    }
    _exit(0);
}
} // namespace

std::string do_in_child(const std::function<void()> &work)
{
    const SharedArray<char> message(longest_message);
    message_of_child = &message[0];
    std::fflush(nullptr); // or the child would write it, too
    const pid_t child = fork();
    if (child < 0)
        return std::string("a process for the replay cannot be created: ") + std::strerror(errno);
    if (child == 0)
        run_child(work);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
    {}
    if (status == 0)
        return "";
    if (*message_of_child)
        return printable(message_of_child);
    return WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "the process ended without a message";
}
} // namespace ode_predictive_space::recording
