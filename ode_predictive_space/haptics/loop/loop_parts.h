// The parts that both kinds of loops share.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_PARTS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_PARTS_H

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/loop/loop_guard.h"
#include "ode_predictive_space/haptics/loop/scene_bodies.h"
#include "ode_predictive_space/haptics/loop/scheduling.h"
#include "ode_predictive_space/haptics/loop/time_histogram.h"
#include "ode_predictive_space/haptics/safety/active_run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

namespace ode_predictive_space::haptics
{
/// Statistics of one kind of tick. One thread writes, any thread reads.
class TickStatistics
{
public:
    void begin(double now)
    {
        if (begin_)
            periods_.add(now - *begin_);
        begin_ = now;
    }

    void end(double now, double next_due)
    {
        computes_.add(now - *begin_);
        if (now > next_due)
            overruns_.store(overruns() + 1, std::memory_order_relaxed);
    }

    TimeSummary periods() const { return periods_.summary(); }
    TimeSummary computes() const { return computes_.summary(); }
    std::uint64_t ticks() const { return computes_.count(); }
    std::uint64_t overruns() const { return overruns_.load(std::memory_order_relaxed); }

private:
    TimeHistogram periods_;
    TimeHistogram computes_;
    std::atomic<std::uint64_t> overruns_{0};
    std::optional<double> begin_;
};

/// Advances a deadline. @return the number of dropped periods, when more than most_behind are missed.
inline std::uint64_t go_on(double &due, double period, int most_behind, double now)
{
    due += period;
    const double behind = std::floor((now - due) / period);
    if (behind <= most_behind)
        return 0;
    due += behind * period;
    return static_cast<std::uint64_t>(behind);
}

/// The number of steps of the scene that fit into half of a period, by their measured times in s.
class StepBudget
{
public:
    void note(double took) { longest_ = std::max(took, forgetting * longest_.value_or(0)); }

    int affordable(double period) const
    {
        return longest_ ? static_cast<int>(std::clamp(0.5 * period / std::max(*longest_, shortest), 1.0, enough)) : 1;
    }

private:
    static constexpr double forgetting = 0.95; ///< factor per step of the longest time
    static constexpr double shortest = 1e-6;
    static constexpr double enough = 100;

    std::optional<double> longest_; ///< recent
};

/// s.
struct LoopTimes
{
    double first = 0;                 ///< simulated; the device's time continues from run to run
    std::atomic<double> start{0};     ///< on the clock
    std::atomic<double> end{0};       ///< on the clock; 0 while it runs
    std::atomic<double> simulated{0}; ///< since the start
};

struct LoopCounts
{
    std::atomic<std::uint64_t> dropped{0};
    std::atomic<std::uint64_t> saturated{0};
    std::atomic<std::uint64_t> trial_messages{0};
    std::atomic<std::uint64_t> notices{0};
};

/// State of a run of either kind. For the caller's thread, unless stated otherwise.
class LoopParts
{
public:
    /// @throws std::invalid_argument as HapticLoop does.
    LoopParts(HapticProbe &haptic_probe, LoopSettings loop_settings);

    /// Ends a run in another thread, and waits for it.
    ~LoopParts();
    LoopParts(const LoopParts &) = delete;
    LoopParts &operator=(const LoopParts &) = delete;

    /// Locks the shared scene, except during sleep_until(). For the thread of run().
    std::unique_lock<std::mutex> take_scene();

    /// Sleeps with the scene unlocked. For the thread of run().
    void sleep_until(double time);

    /// Takes the probe for this run until the result is destroyed. @throws std::logic_error when another loop runs the probe.
    AtEnd begin_turn();

    /// Calls the program's collide(). @throws its exceptions; std::runtime_error for a body that is not finite before or after.
    void collide(const SceneWork &work);

    /// Whether a stop was requested. From any thread.
    bool stop_requested() const;

    /// Whether the loop has to end: by request, or because the sink failed. From the threads of the scene and the servo.
    bool must_end() const;

    /// s; simulated device time, for notices. From any thread.
    double now() const { return time.first + time.simulated; }

    void note_rendered(const RenderedTick &tick);

    void ask_for_priority(bool above_servo);

    /// Sends a notice by the guard. For the thread of the given side.
    void notify(NoticeKind kind, std::string_view sentence, LoopGuard::Side side = LoopGuard::Side::servo)
    {
        guard->post(Notice(kind, now(), sentence), side);
    }

    HapticProbe &probe;
    LoopSettings settings;
    MonotonicClock machine_clock;
    LoopClock &clock;
    std::unique_ptr<LoopGuard> guard; ///< during a run
    SchedulingOutcome scheduling;
    Snapshot<RenderedTick> rendered; ///< from the servo to the scene
    TickStatistics servo;
    TickStatistics scene;
    std::atomic<bool> stopped{false};
    LoopTimes time;
    LoopCounts counts;

private:
    dGeomID scene_geom() const;
    void check_bodies();

    std::optional<SceneBodies> bodies_; ///< during a run
    std::shared_ptr<ActiveRun> run_;    ///< shared by std::atomic_load() and std::atomic_store()
};

/// The caller's thread steps the scene, another one is the servo. @throws exceptions of the law in the servo's thread, too.
void run_decoupled(LoopParts &parts, const SceneWork &work);
} // namespace ode_predictive_space::haptics

#endif
