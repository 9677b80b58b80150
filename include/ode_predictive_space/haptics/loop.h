// The servo loop: runs a probe at a fixed rate of the wall clock.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_LOOP_H

#include "ode_predictive_space/haptics/probe.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace ode_predictive_space::haptics
{
/// A periodic task.
struct PeriodicTask
{
    double period = 0.001;                 ///< s, > 0
    std::function<void()> prepare;         ///< called once before, in the task's thread; may be empty
    std::function<void(double)> carry_out; ///< gets its due time, s. Must not throw
};

/// A running periodic task. The destructor ends it, and waits for it.
class RunningTask
{
public:
    virtual ~RunningTask() = default;
};

/// A clock in seconds since a fixed moment, which never goes back.
class LoopClock
{
public:
    virtual ~LoopClock() = default;

    /// From any thread.
    virtual double now() const = 0;

    /// Sleeps until a time, s; returns at once if it has passed.
    virtual void sleep_until(double time) = 0;

    /// Runs the task after a period, and then in each period, concurrently with the caller. Missed periods are skipped.
    ///
    /// @throws std::system_error when no thread can be created.
    virtual std::unique_ptr<RunningTask> start(PeriodicTask task) = 0;
};

/// The machine's monotonic clock. It sleeps until absolute deadlines, so periods do not drift; each task has a thread.
class MonotonicClock : public LoopClock
{
public:
    double now() const override;
    void sleep_until(double time) override;
    std::unique_ptr<RunningTask> start(PeriodicTask task) override;
};

/// A clock whose time passes only in sleep_until() and advance(), which run due tasks in the calling thread, in the
/// order of their times and starts: deterministic.
class SimulatedClock : public LoopClock
{
public:
    SimulatedClock();
    ~SimulatedClock() override;
    double now() const override;
    void sleep_until(double time) override;

    /// Lets time pass, and runs due tasks that are not running already.
    ///
    /// @param seconds s, >= 0.
    void advance(double seconds);

    /// Starts a task, which the clock must outlive.
    std::unique_ptr<RunningTask> start(PeriodicTask task) override;

private:
    class Entry;
    Entry *next_due(double until) const;
    void carry_out(Entry &entry);

    double now_ = 0;               ///< s
    std::vector<Entry *> entries_; ///< in the order of their start
};

/// Statistics of times, in s; all 0 without times.
struct TimeSummary
{
    std::uint64_t count = 0; ///< number of times
    double mean = 0;         ///< arithmetic mean
    double p50 = 0;          ///< median
    double p99 = 0;          ///< 99th percentile
    double p999 = 0;         ///< 99.9th percentile
    double max = 0;          ///< maximum
};

/// The program's part of a step. Its exceptions end the loop with zero force, and run() rethrows them.
struct SceneWork
{
    std::function<void()>
        collide; ///< dSpaceCollide() with HapticProbe::touch() in the near callback, and contact joints
    std::function<void(double dt)> advance; ///< dWorldStep() and other work of a step of dt seconds; dt may change
};

/// Settings of a loop.
struct LoopSettings
{
    double rate = 1000;         ///< Hz; of the servo
    bool decoupled = false;     ///< whether a separate servo thread renders a local model of the scene
    double physics_rate = 1000; ///< Hz; of a decoupled scene, at most `rate`. A single-threaded loop steps at `rate`
    double duration = std::numeric_limits<double>::infinity(); ///< s, simulated
    int most_steps_behind = 4; ///< maximum of delayed steps that are made up for; a larger backlog is dropped
    double margin = 0.01; ///< m, in the scene; distance of surfaces from a sphere's probe that a decoupled servo knows
    bool ask_for_priority =
        true;                   ///< SCHED_FIFO and locked memory; a refusal is reported, and the loop continues without
    LoopClock *clock = nullptr; ///< 0: the machine's clock. Not owned
    /// Mutex of a scene that several loops share, each in its own thread: run() and the callbacks hold it, except while
    /// run() sleeps. Not owned.
    std::mutex *scene = nullptr;
    NoticeSink notice; ///< called from a separate thread, so it may print and wait. Its exceptions end the loop
};

/// Report of a loop, after or during its run.
struct LoopReport
{
    std::uint64_t ticks = 0;          ///< of the servo
    std::uint64_t steps = 0;          ///< of the scene
    TimeSummary period;               ///< s; from one tick of the servo to the next
    TimeSummary compute;              ///< s; time of a tick of the servo, with the scene's step unless decoupled
    TimeSummary step_compute;         ///< s; time of a step of the scene; equal to compute unless decoupled
    double rate = 0;                  ///< Hz; mean of the servo
    double real_time_factor = 0;      ///< simulated seconds per second of the clock
    std::uint64_t overruns = 0;       ///< ticks that ended after the next was due
    std::uint64_t dropped_steps = 0;  ///< of a scene that was too far behind
    std::uint64_t saturated = 0;      ///< ticks with a clamped force
    std::uint64_t trial_messages = 0; ///< suppressed messages of ODE about trial steps (two threads)
    std::uint64_t notices = 0;        ///< sent to the sink
    std::string scheduling;           ///< granted and refused priority and memory, in sentences
};

class LoopParts;

/// Runs a probe.
///
/// Single-threaded, the default: read, collide, render, write and step in the caller's thread, at the servo's rate.
///
/// Decoupled: the caller's thread steps the scene at its own rate and publishes the geoms around the probe; a servo
/// thread reads the device, moves those geoms by their predicted motion, renders them and writes the force. Its cost
/// does not depend on the size of the scene. The scene gets each impulse of the hand exactly once. Between collide()
/// and advance() the library makes trial steps of bodies connected with the touched ones, and restores them:
/// docs/haptics/guide.md lists the requirements. Near light bodies on joints or in contact, collide() and advance() are
/// called several times as often, with a shorter dt. A tool body is not possible.
///
/// A body whose position, rotation, velocity, spin, force or torque is not finite ends the loop before the scene is
/// collided or stepped with it, with a std::runtime_error that names the body. Before and after collide(), the loop
/// checks all bodies of the worlds whose geoms are in the spaces around the probe's at the beginning of the run, except
/// in ODE's quadtrees. If no such world exists then, the first one is found later.
///
/// Before the first force, all meshes around the probe are read by TouchSensor::prepare_all() and
/// dPredictiveSpacePrepare().
///
/// Every end of the loop sets zero force: the end of the duration, stop() or a StopRequest (within 1 ms, even during
/// the program's part of a tick), an exception of the program (which run() rethrows), a lost device. A hanging scene or
/// servo is detected:
/// - a servo, and with it the scene of a single-threaded loop, by a guard thread, which sets zero force within 5 ms of
///   the due time of the next tick: 6 ms after the last one at 1 kHz and above, 10 ms at 200 Hz, 15 ms at 100 Hz;
/// - the scene of a decoupled loop by the servo's watchdog, whose force is zero 8 ms after the due time of the next
///   step: 9 ms after the last one at 1 kHz and above, 10 ms at 500 Hz, 18 ms at 100 Hz. A driver that hangs in read()
///   or write() cannot be interrupted; a notice reports it.
class HapticLoop
{
public:
    /// @param probe not owned. During run() the program may use it in collide() and advance(); in a decoupled loop only
    ///         touch(), touches() and encounters(), because the rest belongs to the servo: see latest().
    /// @throws std::invalid_argument for a rate that is not above 0, and for a decoupled loop with a tool body;
    ///        std::logic_error when another loop runs the probe.
    HapticLoop(HapticProbe &probe, LoopSettings settings);

    /// Ends a run in another thread, and waits for it, as HapticProbe's destructor does.
    ~HapticLoop();
    HapticLoop(const HapticLoop &) = delete;
    HapticLoop &operator=(const HapticLoop &) = delete;

    /// Runs until the end of the duration, stop(), or StopRequest::requested(). During the run, SIGINT, SIGTERM, SIGHUP
    /// and SIGQUIT request a stop: they end the loop and not the program (see StopRequest::signal()). Can be called
    /// once.
    ///
    /// @return the report at the end.
    /// @throws std::logic_error when it has run, or another loop runs the probe; std::runtime_error for a body that is
    ///         not finite; exceptions of the program's callbacks, the sink of notices or the force law, after zero
    ///         force was set.
    LoopReport run(const SceneWork &work);

    /// From any thread.
    void stop();

    /// The last rendered tick. For the program's collide() and advance().
    const RenderedTick &latest() const;

    /// The present report. From any thread, also during the run.
    LoopReport report() const;

private:
    std::unique_ptr<LoopParts> parts_;
};
} // namespace ode_predictive_space::haptics

#endif
