// Supervision of a servo by other threads, and delivery of its notices.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_GUARD_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_GUARD_H

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/loop/notice_post.h"
#include "ode_predictive_space/haptics/safety/device_gate.h"

#include <limits>

namespace ode_predictive_space::haptics
{
/// Settings and callbacks of a guard. The guard's own threads call the callbacks. An empty callback is skipped.
struct GuardDuties
{
    double stall_after = 0.005;     ///< s; from the last beat until the servo counts as hung
    double scene_stall_after = 0;   ///< s; from the last step until the scene's thread counts as hung
    std::function<bool()> must_end; ///< whether the force has to end
    NoticeSink sink;
    std::function<double()> time;  ///< s, simulated; of notices
    std::function<void()> prepare; ///< in the guard's thread, before it begins
};

/// Checks every millisecond whether the servo ticks and whether the loop has to end; sets the force to zero when the servo
/// hangs or the loop must end. A clock of the program can go back, and then all tasks that sleep by it stall: the machine's
/// clock detects that. Another thread delivers notices to the sink, so that neither servo nor guard waits for a terminal.
class LoopGuard
{
public:
    /// In the scene's thread.
    LoopGuard(LoopClock &clock, DeviceGate &gate, GuardDuties duties);
    ~LoopGuard();
    LoopGuard(const LoopGuard &) = delete;
    LoopGuard &operator=(const LoopGuard &) = delete;

    /// For the servo: a tick begins. The first beat starts the supervision.
    void beat(double now) { last_beat_.store(now, std::memory_order_relaxed); }

    /// For the scene's thread of a decoupled loop: a step begins. A stall ends the forces of other probes that the
    /// program runs in this thread.
    void begin_step(double now) { scene_.last.store(now, std::memory_order_relaxed); }

    void end_steps() { scene_.last.store(never, std::memory_order_relaxed); }

    using Side = NoticePost::Side;
    void post(const Notice &notice, Side side = Side::servo) { notices_.post(notice, side); }

    /// After the servo has ended: stops the supervision, and delivers posted notices.
    void end();

    bool sink_failed() const { return notices_.sink_failed(); }
    std::exception_ptr sink_error() const { return notices_.sink_error(); }

private:
    void look();
    void look_at_clock();
    void stop_force(double now, double beat);
    void notify(std::string_view sentence, Side side = Side::watch);
    bool take_force(double now);

    static constexpr double never = std::numeric_limits<double>::infinity();

    struct SceneSteps
    {
        std::atomic<double> last{never};
        double stopped = never; ///< the last step before a handled stall
        const std::thread::id thread = std::this_thread::get_id();
    };

    LoopClock &clock_;
    DeviceGate &gate_;
    GuardDuties duties_;
    std::atomic<double> last_beat_{never};
    double stopped_beat_ = never; ///< the last beat before a handled stall
    double busy_beat_ = never;    ///< the last beat before a reported hang of the driver
    SceneSteps scene_;
    bool ended_ = false; ///< must_end() was handled
    NoticePost notices_;
    MonotonicClock machine_clock_;
    double newest_ = -never;             ///< s; of the loop's clock
    bool has_gone_back_ = false;         ///< and the force is not yet zero
    std::unique_ptr<RunningTask> watch_; ///< last, because they use the others
    std::unique_ptr<RunningTask> speaker_;
    std::unique_ptr<RunningTask> clock_watch_; ///< 0 for clocks of the library
};
} // namespace ode_predictive_space::haptics

#endif
