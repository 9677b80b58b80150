#include "ode_predictive_space/haptics/safety/program_end.h"

#include "ode_predictive_space/haptics/safety/open_gates.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <string_view>
#include <sys/time.h>
#include <unistd.h>

namespace ode_predictive_space::haptics
{
namespace
{
std::atomic<bool> is_installed{false};
std::terminate_handler earlier_terminate_handler = nullptr;
struct sigaction earlier_abort_action;

/// In a signal handler.
void tell(std::string_view sentence) noexcept
{
    if (write(STDERR_FILENO, sentence.data(), sentence.size()) < 0)
        return; // there is no other place to say it
}

extern "C" void kill_hanging_program(int number)
{
    tell("ode_predictive_space: The program hangs in the device's driver at its end, and is killed: only the device "
         "itself "
         "can remove its force.\n");
    raise(number); // which has its default action again
}

/// SIGALRM kills the program when this is still there after a second.
class Deadline
{
public:
    Deadline() noexcept
    {
        struct sigaction action = {};
        action.sa_handler = &kill_hanging_program;
        action.sa_flags = static_cast<int>(SA_RESETHAND);
        sigaction(SIGALRM, &action, &earlier_action_);
        sigset_t alarm;
        sigemptyset(&alarm);
        sigaddset(&alarm, SIGALRM);
        pthread_sigmask(SIG_UNBLOCK, &alarm, &earlier_mask_);
        const itimerval second = {{0, 0}, {1, 0}};
        setitimer(ITIMER_REAL, &second, &earlier_timer_);
    }

    ~Deadline()
    {
        setitimer(ITIMER_REAL, &earlier_timer_, nullptr);
        pthread_sigmask(SIG_SETMASK, &earlier_mask_, nullptr);
        sigaction(SIGALRM, &earlier_action_, nullptr);
    }

    Deadline(const Deadline &) = delete;
    Deadline &operator=(const Deadline &) = delete;

private:
    struct sigaction earlier_action_ = {};
    sigset_t earlier_mask_ = {};
    itimerval earlier_timer_ = {};
};

void end_forces_and_terminate()
{
    end_all_forces();
    if (earlier_terminate_handler != nullptr)
        earlier_terminate_handler();
    std::abort();
}

/// abort() ends the program in the thread that called it: what is safe in a terminate handler is safe here.
extern "C" void end_forces_and_abort(int number)
{
    if (!open_gates::is_empty())
    {
        end_all_forces();
        tell("ode_predictive_space: The program ends: no force any more.\n");
    }
    sigaction(SIGABRT, &earlier_abort_action, nullptr);
    raise(number);
}
} // namespace

void guard_program_end() noexcept
{
    if (is_installed.exchange(true))
        return;
    std::atexit(&end_all_forces);
    std::at_quick_exit(&end_all_forces);
    earlier_terminate_handler = std::set_terminate(&end_forces_and_terminate);
    struct sigaction action = {};
    action.sa_handler = &end_forces_and_abort;
    sigaction(SIGABRT, &action, &earlier_abort_action);
}

void end_all_forces() noexcept
{
    if (open_gates::is_empty())
        return;
    const Deadline deadline;
    open_gates::shut_all();
}
} // namespace ode_predictive_space::haptics
