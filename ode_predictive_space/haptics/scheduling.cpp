#include "ode_predictive_space/haptics/scheduling.h"

#include <cerrno>
#include <pthread.h>
#include <sys/mman.h>
#include <system_error>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int servo_priority = 70; // of 1 to 99; below the kernel's own threads for interrupts that need it
constexpr int guard_priority = 71;

std::string reason(int error)
{
    return " (" + std::generic_category().message(error) + "). ";
}
} // namespace

std::string SchedulingOutcome::text() const
{
    if (!asked)
    {
        return "Neither real-time priority nor locked memory was asked for.";
    }
    std::string text;
    text += priority_error == 0
                ? "The servo has real-time priority. "
                : "No real-time priority" + reason(priority_error) +
                      "Other programs can delay the servo; an rtprio limit in /etc/security/limits.conf permits it. ";
    text += memory_error == 0
                ? "Memory is locked."
                : "Memory is not locked" + reason(memory_error) +
                      "Paging can delay the servo; a memlock limit in /etc/security/limits.conf permits it.";
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

LockedMemory::LockedMemory(std::atomic<int> &error) : granted_(mlockall(MCL_CURRENT | MCL_FUTURE) == 0)
{
    error = granted_ ? 0 : errno;
}

LockedMemory::~LockedMemory()
{
    if (granted_)
    {
        munlockall();
    }
}
} // namespace ode_predictive_space::haptics
