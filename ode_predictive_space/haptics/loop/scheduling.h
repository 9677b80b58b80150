// What a system can do for a thread that must be punctual.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SCHEDULING_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SCHEDULING_H

#include <atomic>
#include <sched.h>
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

/// Gives the thread that made it, and that ends it, the scheduling back that it had.
class SchedulingKeeper
{
public:
    SchedulingKeeper();
    ~SchedulingKeeper();
    SchedulingKeeper(const SchedulingKeeper &) = delete;
    SchedulingKeeper &operator=(const SchedulingKeeper &) = delete;

private:
    int policy_ = SCHED_OTHER;
    sched_param parameters_{};
};

/// As long as it lives, the process's memory stays where it is and is never paged out, as far as the system permits. What was locked
/// before, by the program, is locked after.
class LockedMemory
{
public:
    explicit LockedMemory(std::atomic<int> &error);
    ~LockedMemory();
    LockedMemory(const LockedMemory &) = delete;
    LockedMemory &operator=(const LockedMemory &) = delete;

private:
    bool was_locked_; ///< some of it: the system cannot unlock the rest alone
    bool granted_;
};
} // namespace ode_predictive_space::haptics

#endif
