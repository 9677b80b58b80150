// What both kinds of loops are made of.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_PARTS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_PARTS_H

#include "ode_predictive_space/haptics/active_run.h"
#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/loop_guard.h"
#include "ode_predictive_space/haptics/scheduling.h"

namespace ode_predictive_space::haptics
{
/// Of one kind of tick. Counted in one thread, read in any.
class TickStatistics
{
public:
    void begin(double now);

    /// @param next_due s; when the next tick was to begin.
    void end(double now, double next_due);

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

/// Absolute deadlines, of which some may be made up for and the rest is dropped.
class Pacer
{
public:
    Pacer(double start, double period, int most_behind);

    double due() const { return due_; }

    /// From the next deadline on.
    void set_period(double period, int most_behind)
    {
        period_ = period;
        most_behind_ = most_behind;
    }

    /// The next deadline. @return how many were dropped, since more than most_behind would have to be made up for.
    std::uint64_t go_on(double now);

private:
    double due_;
    double period_;
    int most_behind_;
};

/// All that a run of a loop needs. It belongs to the caller's thread, but for what says otherwise.
class LoopParts
{
public:
    /// @throws std::invalid_argument as HapticLoop does.
    LoopParts(HapticProbe &haptic_probe, LoopSettings loop_settings);

    ~LoopParts();
    LoopParts(const LoopParts &) = delete;
    LoopParts &operator=(const LoopParts &) = delete;

    /// What it returns is the last that it touches: the loop may be destroyed then, by another thread.
    LoopReport run(const SceneWork &work);
    LoopReport report() const;

    /// The program's part of a tick. @throws std::runtime_error when the scene has a body that must not be stepped, before or after
    /// that; what the program throws.
    void collide(const SceneWork &work);

    /// Whether the loop was asked to end. From any thread.
    bool is_told_to_stop() const;

    /// Whether it has to: for that, or since notices cannot be told. From the threads of the scene and the servo.
    bool must_end() const;

    /// s; simulated, by the device's time: for notices. From any thread.
    double now() const { return first_time + simulated; }

    /// Of the servo.
    void note_rendered(const RenderedTick &tick);

    HapticProbe &probe;
    LoopSettings settings;
    MonotonicClock machine_clock;
    LoopClock &clock;
    std::unique_ptr<LoopGuard> guard; ///< during run()
    SchedulingOutcome scheduling;
    Snapshot<RenderedTick> rendered; ///< by the servo, for the scene
    TickStatistics servo;
    TickStatistics scene;
    std::atomic<bool> stopped{false};
    double first_time = 0;            ///< s, simulated; by the device's time, which goes on from run to run
    std::atomic<double> start{0};     ///< s, on the clock
    std::atomic<double> end{0};       ///< s, on the clock; 0 while it runs
    std::atomic<double> simulated{0}; ///< s
    std::atomic<std::uint64_t> dropped{0};
    std::atomic<std::uint64_t> saturated{0};
    std::atomic<std::uint64_t> notices{0};
    std::atomic<std::uint64_t> held_back{0};

private:
    class Watch;
    class Turn;

    void check_bodies();
    void run_watched(const SceneWork &work);
    void run_coupled(const SceneWork &work);   ///< in one thread
    void run_decoupled(const SceneWork &work); ///< in two
    std::function<void()> priority_request(bool above_servo);
    static double stall_after(double rate); ///< s

    mutable std::mutex run_mutex_; ///< of the one below
    std::shared_ptr<ActiveRun> run_;
};
} // namespace ode_predictive_space::haptics

#endif
