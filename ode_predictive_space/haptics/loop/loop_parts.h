// What both kinds of loops are made of.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_PARTS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_PARTS_H

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/loop/loop_guard.h"
#include "ode_predictive_space/haptics/loop/scheduling.h"
#include "ode_predictive_space/haptics/safety/active_run.h"

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

/// s.
struct LoopTimes
{
    double first = 0;                 ///< simulated; by the device's time, which goes on from run to run
    std::atomic<double> start{0};     ///< on the clock
    std::atomic<double> end{0};       ///< on the clock; 0 while it runs
    std::atomic<double> simulated{0}; ///< since the start
};

/// See LoopReport.
struct LoopCounts
{
    std::atomic<std::uint64_t> dropped{0};
    std::atomic<std::uint64_t> saturated{0};
    std::atomic<std::uint64_t> notices{0};
    std::atomic<std::uint64_t> held_back{0};
};

/// What a run of a loop of either kind needs. It belongs to the caller's thread, but for what says otherwise.
class LoopParts
{
public:
    /// From the beginning of a run to its end: the probe is this loop's alone.
    class Turn
    {
    public:
        /// @throws std::logic_error when another loop runs the probe.
        explicit Turn(LoopParts &parts);
        ~Turn();
        Turn(const Turn &) = delete;
        Turn &operator=(const Turn &) = delete;

    private:
        LoopParts &parts_;
        std::shared_ptr<ActiveRun> run_;
    };

    /// @throws std::invalid_argument as HapticLoop does.
    LoopParts(HapticProbe &haptic_probe, LoopSettings loop_settings);

    /// A run in another thread is ended and waited for.
    ~LoopParts();
    LoopParts(const LoopParts &) = delete;
    LoopParts &operator=(const LoopParts &) = delete;

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

    /// For the thread that is to run it: asks for its priority. Empty where none is to be asked for.
    std::function<void()> priority_request(bool above_servo);

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
    void check_bodies();

    mutable std::mutex run_mutex_; ///< of the one below
    std::shared_ptr<ActiveRun> run_;
};
} // namespace ode_predictive_space::haptics

#endif
