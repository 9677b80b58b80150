// Watches a servo from beside it, and speaks for it.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_GUARD_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_GUARD_H

#include "ode_predictive_space/haptics/device_gate.h"
#include "ode_predictive_space/haptics/exchange.h"
#include "ode_predictive_space/haptics/loop_clock.h"
#include "ode_predictive_space/haptics/notice.h"

namespace ode_predictive_space::haptics
{
/// Looks every millisecond whether the servo still ticks; when it does not, sets the force to zero. It also hands the servo's notices
/// to the program's sink, so that no servo has to wait for a terminal.
class LoopGuard
{
public:
    /// @param stall_after s; so long after the last beat, the servo hangs.
    /// @param prepare where the guard runs, before it begins; may be empty.
    LoopGuard(LoopClock &clock, DeviceGate &gate, double stall_after, NoticeSink sink, std::function<void()> prepare);
    ~LoopGuard();
    LoopGuard(const LoopGuard &) = delete;
    LoopGuard &operator=(const LoopGuard &) = delete;

    /// Of the servo: it ticks. The first one begins the watch.
    void beat(double now) { last_beat_.store(now, std::memory_order_relaxed); }

    /// Of the servo; neither allocates nor waits. Lost when a hundred others are on their way.
    void post(const Notice &notice);

    /// Of who made it, when the servo beats no more: the watch is over, and what was posted is delivered.
    void end();

private:
    void look();
    void stop_force(double now, double beat);
    void deliver(const Notice &notice) const;
    void deliver_posted();

    static constexpr std::size_t most_notices = 100; ///< on their way

    LoopClock &clock_;
    DeviceGate &gate_;
    double stall_after_;
    NoticeSink sink_;
    Queue<Notice> posted_{most_notices};
    std::atomic<double> last_beat_;
    double stopped_beat_;               ///< the last beat before a stall that has been dealt with
    double busy_beat_;                  ///< the same, told that the driver hangs
    std::unique_ptr<RunningTask> task_; ///< last: it uses the others
};
} // namespace ode_predictive_space::haptics

#endif
