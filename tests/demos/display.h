// A virtual display for a test: Xvfb, which draws into memory.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_DEMOS_DISPLAY_H
#define ODE_PREDICTIVE_SPACE_TESTS_DEMOS_DISPLAY_H

#include <csignal>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace ode_predictive_space
{
class VirtualDisplay
{
public:
    /// @throws std::runtime_error if Xvfb does not start.
    VirtualDisplay()
    {
        int ends[2];
        if (pipe(ends) != 0 || (process_ = fork()) < 0)
        {
            throw std::runtime_error("cannot start Xvfb");
        }
        if (process_ == 0)
        {
            close(ends[0]);
            const std::string descriptor = std::to_string(ends[1]);
            execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1400x1000x24", "-nolisten", "tcp",
                   static_cast<char *>(nullptr));
            _exit(127);
        }
        close(ends[1]);
        // When it is ready, it writes the number of its display and a new line.
        for (char digit = 0; read(ends[0], &digit, 1) == 1 && digit != '\n';)
        {
            name_ += digit;
        }
        close(ends[0]);
        if (name_.empty())
        {
            waitpid(process_, nullptr, 0);
            throw std::runtime_error("Xvfb does not start: is the package xvfb installed?");
        }
        name_ = ":" + name_;
    }

    ~VirtualDisplay()
    {
        kill(process_, SIGTERM);
        waitpid(process_, nullptr, 0);
    }

    VirtualDisplay(const VirtualDisplay &) = delete;
    VirtualDisplay &operator=(const VirtualDisplay &) = delete;

    const std::string &name() const { return name_; }

private:
    pid_t process_ = -1;
    std::string name_;
};
} // namespace ode_predictive_space

#endif
