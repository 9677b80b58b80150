// The servo loop: a probe at a fixed rate, in step with the wall clock.

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

/// Of many times, in seconds. All 0 when there were none.
struct TimeSummary
{
    std::uint64_t count = 0; ///< how many times
    double mean = 0;         ///< of all
    double p50 = 0;          ///< half of the times are not longer
    double p99 = 0;          ///< 99 % are not longer
    double p999 = 0;         ///< 99.9 % are not longer
    double max = 0;          ///< the longest
};

/// What a program does in each step of its scene. Exceptions end the loop, with zero force, and come out of run().
struct SceneWork
{
    std::function<void()>
        collide; ///< dSpaceCollide(), with HapticProbe::touch() in the near callback, and all contact joints
    std::function<void(double dt)> advance; ///< dWorldStep() and what else is to happen in dt seconds; dt may change
};

/// How a loop runs.
struct LoopSettings
{
    double rate = 1000;     ///< Hz; of the servo
    bool decoupled = false; ///< whether the servo has a thread of its own, and feels a local model of the scene
    double physics_rate =
        1000; ///< Hz; of the scene when decoupled, not more than rate. Else it is stepped at the servo's rate
    double duration = std::numeric_limits<double>::infinity(); ///< s, simulated
    int most_steps_behind =
        4; ///< a scene that lags makes up for so many steps. Of more, it drops all: simulated time lags, then
    double margin =
        0.01; ///< m, in the scene; how far around a sphere's probe the servo knows of surfaces when decoupled
    bool ask_for_priority = true; ///< SCHED_FIFO and locked memory; what is refused is told, and done without
    LoopClock *clock = nullptr;   ///< 0: the machine's. Not owned
    /// Of a scene that several loops share, each in a thread of its own: run() holds it except while it sleeps, and the callbacks with it.
    /// Not owned.
    std::mutex *scene = nullptr;
    NoticeSink notice; ///< called from a thread beside the loop: it may print and wait. What it throws ends the loop
};

/// How a loop ran, or runs.
struct LoopReport
{
    std::uint64_t ticks = 0;         ///< of the servo
    std::uint64_t steps = 0;         ///< of the scene
    TimeSummary period;              ///< s; from one tick of the servo to the next
    TimeSummary compute;             ///< s; that a tick of the servo took, with the scene's step unless decoupled
    TimeSummary step_compute;        ///< s; that a step of the scene took; the same as compute unless decoupled
    double rate = 0;                 ///< Hz; of the servo, over all
    double real_time_factor = 0;     ///< simulated seconds per second of the clock
    std::uint64_t overruns = 0;      ///< ticks that were not done when the next was due
    std::uint64_t dropped_steps = 0; ///< of the scene: it was too far behind
    std::uint64_t saturated = 0;     ///< ticks in which the force was more than the device can render
    std::uint64_t trial_messages =
        0; ///< of ODE, about steps that were only tried (two threads): they do not reach its handler
    std::uint64_t notices = 0; ///< given to the sink
    std::string scheduling;    ///< which priority and memory the system granted or refused, in sentences
};

class LoopParts;

/// Runs a probe.
///
/// Single-threaded, the default: all in the caller's thread, at the servo's rate: read, collide, force, write, step.
///
/// Decoupled: the caller's thread steps the scene at its own rate and publishes the geoms around the probe; a servo thread
/// reads the device, feels those geoms, moved on as they will move, and writes the force. Its cost depends on what
/// is near the probe, not on the size of the scene. What it gave to the hand comes back to the scene as impulses, none lost
/// and none twice. Between collide() and advance() the library steps what hangs together with the touched bodies on trial, and puts it
/// back: docs/haptics/loop.md has what that asks of a program. Near light bodies on joints or in contact, collide() and advance() are
/// called several times as often, with a shorter dt. The probe's tool must not be a body then.
///
/// A body whose position, rotation, velocity, spin, force or torque is not finite ends the loop before the scene is collided or
/// stepped with it, with a std::runtime_error that names the body. Before and after collide(), all bodies are looked at of the
/// worlds that have a body with a geom in the spaces around the probe's, except in ODE's quadtrees, when the run begins. Where there is
/// no such world yet, the first one is found later.
///
/// Before the first force all meshes around the probe are read: TouchSensor::prepare_all() and dPredictiveSpacePrepare().
///
/// However the loop ends, it ends with zero force: the duration is over, stop() or a StopRequest (within 1 ms, even while the
/// program's part of a tick runs), an exception of the program (which run() rethrows), a lost device. Scene and servo that hang are
/// noticed:
/// - a servo, and with it the scene of a single-threaded loop, by a guard, a thread of the loop, that sets the force to zero within 5 ms
///   of the time at which the next tick should have begun: 6 ms after the last one at 1 kHz and above, 10 ms at 200 Hz, 15 ms at 100 Hz;
/// - the scene of a decoupled loop by the servo's watchdog: the force is gone 8 ms after the next step should have begun: 9 ms after
///   the last one at 1 kHz and above, 10 ms at 500 Hz, 18 ms at 100 Hz.
/// Only where a device's driver hangs in read() or write() nothing here can help: this is told.
class HapticLoop
{
public:
    /// @param probe is not owned. As long as run() runs, the program may use it in its collide() and advance(); of a
    ///        decoupled loop only touch(), touches() and encounters(), as the rest belongs to the servo: see latest().
    /// @throws std::invalid_argument for a rate that is not above 0, and for a decoupled loop with a tool body;
    ///        std::logic_error when another loop runs the probe.
    HapticLoop(HapticProbe &probe, LoopSettings settings);

    /// As HapticProbe's: a run in another thread is ended and waited for.
    ~HapticLoop();
    HapticLoop(const HapticLoop &) = delete;
    HapticLoop &operator=(const HapticLoop &) = delete;

    /// Run until the duration is over, stop() is called, or StopRequest::requested(), which SIGINT, SIGTERM, SIGHUP and
    /// SIGQUIT do as long as it runs: such a signal ends the loop and not the program (see StopRequest::signal()). Once.
    ///
    /// @return the report at the end.
    /// @throws std::logic_error when it has run, or another loop runs the probe; std::runtime_error for a body that is not finite;
    ///        what the program's callbacks throw, the sink of notices among them, or the force law: after the force has been
    ///        taken away.
    LoopReport run(const SceneWork &work);

    /// From any thread.
    void stop();

    /// What was rendered last. For the program's collide() and advance().
    const RenderedTick &latest() const;

    /// From any thread, also while it runs: for the screen, say.
    LoopReport report() const;

private:
    std::unique_ptr<LoopParts> parts_;
};
} // namespace ode_predictive_space::haptics

#endif
