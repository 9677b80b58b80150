#include "ode_predictive_space/process/child_output.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ode_predictive_space::process
{
namespace
{
std::string read_all(int file)
{
    std::string text;
    char part[4096];
    for (;;)
    {
        const ssize_t size = read(file, part, sizeof part);
        if (size > 0)
            text.append(part, static_cast<std::size_t>(size));
        else if (size == 0 || errno != EINTR)
            return text;
    }
}

bool ends_well(pid_t child)
{
    int status = -1;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
    {}
    return status == 0;
}
} // namespace

std::optional<std::string> child_output(const std::function<void(int pipe)> &become)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return std::nullopt;
    const pid_t child = fork();
    if (child == 0)
    {
        become(ends[1]);
        _exit(127);
    }
    close(ends[1]);
    std::string output = read_all(ends[0]);
    close(ends[0]);
    if (child < 0 || !ends_well(child))
        return std::nullopt;
    return output;
}
} // namespace ode_predictive_space::process
