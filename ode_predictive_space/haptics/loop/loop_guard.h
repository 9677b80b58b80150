// Watches a servo from beside it, and speaks for it.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_GUARD_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_GUARD_H

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/loop/notice_post.h"
#include "ode_predictive_space/haptics/safety/device_gate.h"

#include <limits>

namespace ode_predictive_space::haptics
{
/// What a guard is to do. Called from its threads; each function may be empty.
struct GuardDuties
{
    double stall_after = 0.005;     ///< s; so long after the last beat, the servo hangs
    double scene_stall_after = 0;   ///< s; so long after the last step, the scene's thread hangs
    std::function<bool()> must_end; ///< whether there is to be no force any more
    NoticeSink sink;
    std::function<double()> time;  ///< s, simulated; of notices
    std::function<void()> prepare; ///< where the guard runs, before it begins
};

/// Looks every millisecond whether the servo still ticks, and whether it is to end; when it does not or is, sets the force to zero.
///
/// A clock of the program can go back. Then all that sleeps by it sleeps until it has caught up, the watch too: this is found by the machine's
/// own clock.
///
/// A thread beside the watch hands all notices to the program's sink, so that neither servo nor watch has to wait for a terminal.
class LoopGuard
{
public:
    LoopGuard(LoopClock &clock, DeviceGate &gate, GuardDuties duties);
    ~LoopGuard();
    LoopGuard(const LoopGuard &) = delete;
    LoopGuard &operator=(const LoopGuard &) = delete;

    /// Of the servo: it ticks. The first beat begins the watch.
    void beat(double now) { last_beat_.store(now, std::memory_order_relaxed); }

    /// Of the scene's thread, where it is not the servo's: it begins a step. After a stall, the probes that the program runs in this thread
    /// beside the loop's own are without force.
    void begin_step(double now);

    /// Of the same: there are no more steps.
    void end_steps() { scene_.last.store(never, std::memory_order_relaxed); }

    using Side = NoticePost::Side;
    void post(const Notice &notice, Side side = Side::servo) { notices_.post(notice, side); }

    /// When the servo has ended: the watch is over, and what was posted is delivered.
    void end();

    bool sink_failed() const { return notices_.sink_failed(); }
    std::exception_ptr sink_error() const { return notices_.sink_error(); }

private:
    void look();
    void look_at_clock();
    void stop_force(double now, double beat);
    void tell(std::string_view sentence, Side side = Side::watch);
    bool take_force(double now);

    static constexpr double never = std::numeric_limits<double>::infinity();

    /// Of the scene's thread.
    struct SceneSteps
    {
        std::atomic<double> last{never};
        double stopped = never; ///< the last step before a stall that has been dealt with
        std::atomic<std::thread::id> thread{};
    };

    LoopClock &clock_;
    DeviceGate &gate_;
    GuardDuties duties_;
    std::atomic<double> last_beat_{never};
    double stopped_beat_ = never; ///< the last beat before a stall that has been dealt with
    double busy_beat_ = never;    ///< the same, told that the driver hangs
    SceneSteps scene_;
    bool ended_ = false; ///< must_end() has been dealt with
    NoticePost notices_;
    MonotonicClock machine_clock_;
    double newest_ = -never;             ///< s; of the loop's clock
    bool has_gone_back_ = false;         ///< and the force is still to be taken
    std::unique_ptr<RunningTask> watch_; ///< these last: they use the others
    std::unique_ptr<RunningTask> speaker_;
    std::unique_ptr<RunningTask> clock_watch_; ///< 0 for a clock that cannot go back
};
} // namespace ode_predictive_space::haptics

#endif
