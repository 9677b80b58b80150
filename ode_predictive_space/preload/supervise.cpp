#include "ode_predictive_space/preload/supervise.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "ode_predictive_space/recording/printable.h"

namespace ode_predictive_space::preload
{
namespace
{
// As the program would have found it.
struct SignalState
{
    sigset_t mask;
    struct sigaction on_child_end;
};

// The end of a child must not be ignored, which can be inherited.
SignalState block_signals()
{
    SignalState before;
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before.mask);
    struct sigaction by_default = {};
    by_default.sa_handler = SIG_DFL;
    sigaction(SIGCHLD, &by_default, &before.on_child_end);
    return before;
}

[[noreturn]] void begin_program(char **command, const SignalState &signals, pid_t launcher)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != launcher)
        _exit(127); // it has gone already
    sigaction(SIGCHLD, &signals.on_child_end, nullptr);
    sigprocmask(SIG_SETMASK, &signals.mask, nullptr);
    become(command);
}

void close_range_of_files(unsigned first, unsigned last)
{
#ifdef SYS_close_range
    if (first <= last)
        syscall(SYS_close_range, first, last, 0u);
#else
    (void)first;
    (void)last;
#endif
}

void close_all_files_but(int file)
{
    close(STDIN_FILENO);
    close(STDOUT_FILENO);
    close_range_of_files(STDERR_FILENO + 1, static_cast<unsigned>(file) - 1);
    close_range_of_files(static_cast<unsigned>(file) + 1, ~0u);
}

// True when the program has ended.
bool follow_state(pid_t program, int &status)
{
    while (waitpid(program, &status, WNOHANG | WUNTRACED) == program)
    {
        if (!WIFSTOPPED(status))
            return true;
        raise(SIGSTOP); // until somebody continues this process
    }
    return false;
}

// A process that sends a signal to the whole group sends it to the program twice: nothing tells this from one for us alone.
bool is_sent_by_a_process(const siginfo_t &signal)
{
    return signal.si_code <= 0;
}

int wait_for(pid_t program)
{
    sigset_t all;
    sigfillset(&all);
    for (;;)
    {
        siginfo_t signal;
        int status;
        if (sigwaitinfo(&all, &signal) < 0)
            continue;
        if (signal.si_signo != SIGCHLD && is_sent_by_a_process(signal))
            kill(program, signal.si_signo);
        if (signal.si_signo == SIGCHLD && follow_state(program, status))
            return status;
    }
}
} // namespace

void become(char **command)
{
    execvp(command[0], command);
    const int reason = errno;
    std::fprintf(stderr, "ode-predictive: %s: %s\n", printable(command[0]).c_str(), std::strerror(reason));
    _exit(reason == ENOENT ? 127 : 126);
}

int run_and_wait(char **command, int file)
{
    const SignalState signals = block_signals();
    const pid_t launcher = getpid();
    const pid_t program = fork();
    if (program < 0)
    {
        std::fprintf(stderr, "ode-predictive: %s\n", std::strerror(errno));
        std::exit(126);
    }
    if (program == 0)
        begin_program(command, signals, launcher);
    close_all_files_but(file);
    return wait_for(program);
}

void end_like(int status, bool all_written)
{
    if (!WIFSIGNALED(status))
        std::exit(WEXITSTATUS(status) == 0 && !all_written ? 2 : WEXITSTATUS(status));
    const int signal = WTERMSIG(status);
    sigset_t its;
    sigemptyset(&its);
    sigaddset(&its, signal);
    prctl(PR_SET_DUMPABLE, 0);
    std::signal(signal, SIG_DFL);
    sigprocmask(SIG_UNBLOCK, &its, nullptr);
    raise(signal);
    std::exit(128 + signal);
}
} // namespace ode_predictive_space::preload
