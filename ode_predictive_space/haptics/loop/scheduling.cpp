#include "ode_predictive_space/haptics/loop/scheduling.h"

#include <cerrno>
#include <fstream>
#include <pthread.h>
#include <sys/mman.h>
#include <system_error>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int servo_priority = 70; // of 1 to 99; below the kernel's own threads for interrupts that need it
constexpr int guard_priority = 71;

bool is_memory_locked()
{
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word)
    {
        if (word == "VmLck:")
        {
            long kilobytes = 0;
            status >> kilobytes;
            return kilobytes > 0;
        }
    }
    return false;
}

std::string reason(int error)
{
    return " (" + std::generic_category().message(error) + ")";
}
} // namespace

std::string SchedulingOutcome::text() const
{
    if (!asked)
        return "Neither real-time priority nor locked memory was requested.";
    std::string text = priority_error == 0 ? "The servo has real-time priority. "
                                           : "No real-time priority" + reason(priority_error) +
                                                 ": other programs can delay the servo. ";
    text += memory_error == 0 ? "Memory is locked."
                              : "Memory is not locked" + reason(memory_error) + ": paging can delay the servo.";
    if (refused())
        text += " To permit it, set rtprio and memlock in /etc/security/limits.conf.";
    return text;
}

int ask_for_real_time(bool above_servo)
{
    sched_param wanted{};
    wanted.sched_priority = above_servo ? guard_priority : servo_priority;
    return pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
}

AtEnd keep_scheduling()
{
    int policy = SCHED_OTHER;
    sched_param parameters{};
    pthread_getschedparam(pthread_self(), &policy, &parameters);
    return AtEnd([policy, parameters] { pthread_setschedparam(pthread_self(), policy, &parameters); });
}

AtEnd lock_memory(std::atomic<int> &error)
{
    const bool was_locked = is_memory_locked(); // by the program; the system cannot unlock the rest alone
    const bool granted = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
    error = granted ? 0 : errno;
    return granted && !was_locked ? AtEnd([] { munlockall(); }) : AtEnd();
}
} // namespace ode_predictive_space::haptics
