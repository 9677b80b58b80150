// What a system can do for a thread that must be punctual.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SCHEDULING_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SCHEDULING_H

#include "ode_predictive_space/haptics/device/at_end.h"

#include <atomic>
#include <string>

namespace ode_predictive_space::haptics
{
/// What was asked for, and what came of it. May be written and read in different threads.
class SchedulingOutcome
{
public:
    std::atomic<bool> asked{false};
    std::atomic<int> priority_error{0}; ///< errno; 0: granted
    std::atomic<int> memory_error{0};   ///< errno; 0: granted

    bool refused() const { return asked && (priority_error != 0 || memory_error != 0); }

    /// In sentences, with the remedy where something was refused.
    std::string text() const;
};

/// SCHED_FIFO for the calling thread.
///
/// @param above_servo a guard goes before the servo that it guards.
/// @return 0 or errno.
int ask_for_real_time(bool above_servo);

/// What gives this thread the scheduling back that it has now. To be done in the same thread.
AtEnd keep_scheduling();

/// From now on the process's memory stays where it is and is never paged out, as far as the system permits, until what is returned goes.
/// What was locked before, by the program, is locked after.
///
/// @param error becomes 0 or errno.
AtEnd lock_memory(std::atomic<int> &error);
} // namespace ode_predictive_space::haptics

#endif
