// Real-time priority and locked memory.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SCHEDULING_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SCHEDULING_H

#include "ode_predictive_space/haptics/device/at_end.h"

#include <atomic>
#include <string>

namespace ode_predictive_space::haptics
{
/// Results of the requests. Different threads may write and read them.
class SchedulingOutcome
{
public:
    std::atomic<bool> asked{false};
    std::atomic<int> priority_error{0}; ///< errno; 0: granted
    std::atomic<int> memory_error{0};   ///< errno; 0: granted

    bool refused() const { return asked && (priority_error != 0 || memory_error != 0); }

    /// Sentences for people, with a remedy for refused requests.
    std::string text() const;
};

/// Requests SCHED_FIFO for the calling thread.
int ask_for_real_time(bool above_servo);

/// Returns a guard object that restores the present scheduling in the same thread.
AtEnd keep_scheduling();

/// Locks the process's memory against paging, as far as the system permits, until the result is destroyed. Memory that the
/// program has locked before stays locked.
AtEnd lock_memory(std::atomic<int> &error);
} // namespace ode_predictive_space::haptics

#endif
