// What both kinds of loops are made of.

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
/// Of one kind of tick. Counted in one thread, read in any.
class TickStatistics
{
public:
    void begin(double now)
    {
        if (began_)
            periods_.add(now - begin_);
        began_ = true;
        begin_ = now;
    }

    /// @param next_due s; when the next tick was to begin.
    void end(double now, double next_due)
    {
        computes_.add(now - begin_);
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
    double begin_ = 0;
    bool began_ = false;
};

/// From a deadline to the next. @return how many were dropped, since more than most_behind would have to be made up for.
inline std::uint64_t go_on(double &due, double period, int most_behind, double now)
{
    due += period;
    const double behind = std::floor((now - due) / period);
    if (behind <= most_behind)
        return 0;
    due += behind * period;
    return static_cast<std::uint64_t>(behind);
}

/// How often there is time to step the scene: by how long its steps took, how many of them half of a period has time for. Times in s.
class StepBudget
{
public:
    /// @param took a step, with all that the loop and the program do for it.
    void note(double took) { longest_ = std::max(took, forgetting * longest_.value_or(0)); }

    /// At least one; no more as long as nothing was measured.
    int affordable(double period) const
    {
        return longest_ ? static_cast<int>(std::clamp(0.5 * period / std::max(*longest_, shortest), 1.0, enough)) : 1;
    }

private:
    static constexpr double forgetting = 0.95; ///< from step to step, of a step that was longer than the others
    static constexpr double shortest = 1e-6;
    static constexpr double enough = 100;

    std::optional<double> longest_; ///< of late
};

/// s.
struct LoopTimes
{
    double first = 0;                 ///< simulated; by the device's time, which goes on from run to run
    std::atomic<double> start{0};     ///< on the clock
    std::atomic<double> end{0};       ///< on the clock; 0 while it runs
    std::atomic<double> simulated{0}; ///< since the start
};

/// As LoopReport has them. From any thread.
struct LoopCounts
{
    std::atomic<std::uint64_t> dropped{0};
    std::atomic<std::uint64_t> saturated{0};
    std::atomic<std::uint64_t> trial_messages{0};
    std::atomic<std::uint64_t> notices{0};
};

/// What a run of a loop of either kind needs. It belongs to the caller's thread, but for what says otherwise.
class LoopParts
{
public:
    /// @throws std::invalid_argument as HapticLoop does.
    LoopParts(HapticProbe &haptic_probe, LoopSettings loop_settings);

    /// A run in another thread is ended and waited for.
    ~LoopParts();
    LoopParts(const LoopParts &) = delete;
    LoopParts &operator=(const LoopParts &) = delete;

    /// The scene is this loop's alone, but while it sleeps, until what is returned goes. Of the thread of run().
    std::unique_lock<std::mutex> take_scene();

    /// Gives the scene away meanwhile. Of the same thread.
    void sleep_until(double time);

    /// A run begins: the probe is this loop's alone, until what is returned goes. @throws std::logic_error when another loop runs
    /// the probe.
    AtEnd begin_turn();

    /// The program's part of a tick. @throws std::runtime_error when the scene has a body that must not be stepped, before or after
    /// that; what the program throws.
    void collide(const SceneWork &work);

    /// Whether the loop was asked to end. From any thread.
    bool is_told_to_stop() const;

    /// Whether it has to: for that, or since notices cannot be told. From the threads of the scene and the servo.
    bool must_end() const;

    /// s; simulated, by the device's time: for notices. From any thread.
    double now() const { return time.first + time.simulated; }

    /// Of the servo.
    void note_rendered(const RenderedTick &tick);

    /// Real-time priority for the calling thread, unless none is to be asked for.
    void ask_for_priority(bool above_servo);

    /// To the sink of notices, by the guard. Of the thread of the servo, or of the side's.
    void tell(NoticeKind kind, std::string_view sentence, LoopGuard::Side side = LoopGuard::Side::servo)
    {
        guard->post(Notice(kind, now(), sentence), side);
    }

    HapticProbe &probe;
    LoopSettings settings;
    MonotonicClock machine_clock;
    LoopClock &clock;
    std::unique_ptr<LoopGuard> guard; ///< during a run
    SchedulingOutcome scheduling;
    Snapshot<RenderedTick> rendered; ///< by the servo, for the scene
    TickStatistics servo;
    TickStatistics scene;
    std::atomic<bool> stopped{false};
    LoopTimes time;
    LoopCounts counts;

private:
    dGeomID scene_geom() const;
    void check_bodies();

    std::optional<SceneBodies> bodies_; ///< during a run
    std::shared_ptr<ActiveRun> run_;    ///< for other threads by std::atomic_load() and std::atomic_store()
};

/// The loop of two threads: the caller's steps the scene, another one is the servo. Until the duration is over or the loop must end.
/// @throws what the law throws in the servo's thread, too.
void run_decoupled(LoopParts &parts, const SceneWork &work);
} // namespace ode_predictive_space::haptics

#endif
