// The time that loops keep: the machine's, or a simulated one.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_CLOCK_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_CLOCK_H

#include <functional>
#include <memory>
#include <vector>

namespace ode_predictive_space::haptics
{
/// Something to do again and again.
struct PeriodicTask
{
    double period = 0.001;                 ///< s, > 0
    std::function<void()> prepare;         ///< once, before the first time, where the task runs; may be empty
    std::function<void(double)> carry_out; ///< gets the time, in s, at which it was due. Must not throw
};

/// A periodic task. It runs until this is destroyed; the destructor returns when the task has ended.
class RunningTask
{
public:
    virtual ~RunningTask() = default;
};

/// Seconds since some fixed moment; never goes back.
class LoopClock
{
public:
    virtual ~LoopClock() = default;

    /// From any thread.
    virtual double now() const = 0;

    /// Returns at once when that time has passed already.
    virtual void sleep_until(double time) = 0;

    /// Carry out the task a period from now, and each period from then on, beside whatever the caller does. A time that is
    /// missed because the task took too long is left out.
    ///
    /// @throws std::system_error when there can be no thread for it.
    virtual std::unique_ptr<RunningTask> start(PeriodicTask task) = 0;
};

/// The machine's monotonic clock. Sleeps until absolute deadlines, so that periods do not drift; each task has its thread.
class MonotonicClock : public LoopClock
{
public:
    double now() const override;
    void sleep_until(double time) override;
    std::unique_ptr<RunningTask> start(PeriodicTask task) override;
};

/// A clock whose time passes only in sleep_until() and advance(). Then the tasks that are due are carried out, in the
/// order of their times and, among those of the same time, of their start: all in the one thread, the same in each run.
class SimulatedClock : public LoopClock
{
public:
    SimulatedClock();
    ~SimulatedClock() override;
    double now() const override;
    void sleep_until(double time) override;

    /// Let time pass, as something does that takes long. Meanwhile the tasks are carried out that are not being carried out
    /// already.
    ///
    /// @param seconds >= 0.
    void advance(double seconds);

    /// The clock must outlive the task.
    std::unique_ptr<RunningTask> start(PeriodicTask task) override;

private:
    class Entry;
    Entry *next_due(double until) const;
    void carry_out(Entry &entry);

    double now_ = 0;               ///< s
    std::vector<Entry *> entries_; ///< in the order of their start
};
} // namespace ode_predictive_space::haptics

#endif
