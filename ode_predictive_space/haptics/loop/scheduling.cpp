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

/// Whether the process has locked anything so far.
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
        return "Neither real-time priority nor locked memory was asked for.";
    std::string text = priority_error == 0 ? "The servo has real-time priority. "
                                           : "No real-time priority" + reason(priority_error) +
                                                 ": other programs can delay the servo. ";
    text += memory_error == 0 ? "Memory is locked."
                              : "Memory is not locked" + reason(memory_error) + ": paging can delay the servo.";
    if (refused())
        text += " Limits permit it, rtprio and memlock in /etc/security/limits.conf.";
    return text;
}

int ask_for_real_time(bool above_servo)
{
    sched_param wanted{};
    wanted.sched_priority = above_servo ? guard_priority : servo_priority;
    return pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
}

SchedulingKeeper::SchedulingKeeper()
{
    pthread_getschedparam(pthread_self(), &policy_, &parameters_);
}

SchedulingKeeper::~SchedulingKeeper()
{
    pthread_setschedparam(pthread_self(), policy_, &parameters_);
}

LockedMemory::LockedMemory(std::atomic<int> &error)
    : was_locked_(is_memory_locked()), granted_(mlockall(MCL_CURRENT | MCL_FUTURE) == 0)
{
    error = granted_ ? 0 : errno;
}

LockedMemory::~LockedMemory()
{
    if (granted_ && !was_locked_)
        munlockall();
}
} // namespace ode_predictive_space::haptics
