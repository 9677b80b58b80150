#include "ode_predictive_space/haptics/loop.h"

#include "ode_predictive_space/haptics/body_check.h"
#include "ode_predictive_space/haptics/loop_parts.h"
#include "ode_predictive_space/haptics/safe_collide.h"
#include "ode_predictive_space/haptics/stop_request.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double shortest_stall = 0.005; // s; after the last tick
constexpr double overdue = 0.004;        // s; after the next one should have begun

LoopSettings checked(LoopSettings settings, HapticProbe &probe)
{
    if (probe.is_taken())
    {
        throw std::logic_error("Another haptic loop runs the probe");
    }
    if (!settings.decoupled)
    {
        settings.physics_rate = settings.rate;
    }
    if (settings.decoupled && probe.sensor() == nullptr)
    {
        throw std::invalid_argument(
            "A tool body is held by the scene's own step: it cannot be felt by a decoupled loop");
    }
    if (settings.physics_rate > settings.rate || settings.most_steps_behind < 0 || !(settings.margin >= 0))
    {
        throw std::invalid_argument(
            "A loop's scene cannot be faster than its servo, and neither the steps that it may be behind "
            "nor the margin can be less than 0");
    }
    probe.renderer().set_rates(settings.rate, settings.physics_rate);
    return settings;
}
} // namespace

void TickStatistics::begin(double now)
{
    if (began_)
    {
        periods_.add(now - begin_);
    }
    began_ = true;
    begin_ = now;
}

void TickStatistics::end(double now, double next_due)
{
    computes_.add(now - begin_);
    if (now > next_due)
    {
        overruns_.store(overruns() + 1, std::memory_order_relaxed);
    }
}

Pacer::Pacer(double start, double period, int most_behind) : due_(start), period_(period), most_behind_(most_behind) {}

std::uint64_t Pacer::go_on(double now)
{
    due_ += period_;
    const double behind = std::floor((now - due_) / period_);
    if (behind <= most_behind_)
    {
        return 0;
    }
    due_ += behind * period_;
    return static_cast<std::uint64_t>(behind);
}

/// The guard, the notices' way, and what the system grants: from the beginning of a run to its end, whichever that is.
class LoopParts::Watch
{
public:
    explicit Watch(LoopParts &parts) : parts_(parts), sink_(parts.probe.renderer().notice_sink())
    {
        if (parts.settings.ask_for_priority)
        {
            parts.scheduling.asked = true;
            keeper_.emplace();
            memory_.emplace(parts.scheduling.memory_error);
        }
        GuardDuties duties;
        duties.stall_after = parts.stall_after(parts.settings.rate);
        duties.scene_stall_after = parts.stall_after(parts.settings.physics_rate);
        duties.must_end = [&parts] { return parts.is_told_to_stop(); };
        duties.sink = counted(parts.settings.notice ? parts.settings.notice : sink_);
        duties.time = [&parts] { return parts.now(); };
        duties.prepare = parts.priority_request(true);
        parts.guard = std::make_unique<LoopGuard>(parts.clock, parts.probe.renderer().gate(), std::move(duties));
        parts.probe.renderer().set_notice_sink([&parts](const Notice &notice) { parts.guard->post(notice); });
    }

    ~Watch()
    {
        parts_.probe.renderer().relax();
        parts_.end = parts_.clock.now();
        if (parts_.probe.sensor() != nullptr)
        {
            parts_.probe.sensor()->set_margin(0);
        }
        parts_.probe.renderer().tell_held_back();
        tell_of_scheduling();
        parts_.guard->end();
        parts_.probe.renderer().set_notice_sink(sink_);
    }

    Watch(const Watch &) = delete;
    Watch &operator=(const Watch &) = delete;

private:
    NoticeSink counted(NoticeSink sink)
    {
        return [&parts = parts_, sink = std::move(sink)](const Notice &notice) {
            ++parts.notices;
            if (sink)
            {
                sink(notice);
            }
        };
    }

    void tell_of_scheduling()
    {
        if (parts_.scheduling.refused())
        {
            parts_.guard->post(Notice(NoticeKind::scheduling, parts_.now(), parts_.scheduling.text()));
        }
    }

    LoopParts &parts_;
    NoticeSink sink_;
    std::optional<SchedulingKeeper> keeper_;
    std::optional<LockedMemory> memory_;
};

LoopParts::LoopParts(HapticProbe &haptic_probe, LoopSettings loop_settings)
    : probe(haptic_probe), settings(checked(std::move(loop_settings), haptic_probe)),
      clock(settings.clock != nullptr ? *settings.clock : machine_clock)
{}

/// From the beginning of a run to its end: the probe is this loop's alone.
class LoopParts::Turn
{
public:
    explicit Turn(LoopParts &parts) : parts_(parts), run_(std::make_shared<ActiveRun>())
    {
        parts_.probe.take(run_);
        const std::lock_guard<std::mutex> lock(parts_.run_mutex_);
        parts_.run_ = run_;
    }

    ~Turn()
    {
        parts_.probe.give_back();
        run_->end();
    }

    Turn(const Turn &) = delete;
    Turn &operator=(const Turn &) = delete;

private:
    LoopParts &parts_;
    std::shared_ptr<ActiveRun> run_;
};

LoopParts::~LoopParts()
{
    std::shared_ptr<ActiveRun> run;
    {
        const std::lock_guard<std::mutex> lock(run_mutex_);
        run = run_;
    }
    if (run)
    {
        run->end_and_wait("a haptic loop");
    }
}

bool LoopParts::is_told_to_stop() const
{
    return stopped.load(std::memory_order_relaxed) || run_->is_told_to_stop() || StopRequest::requested();
}

bool LoopParts::must_end() const
{
    return is_told_to_stop() || guard->sink_failed();
}

double LoopParts::stall_after(double rate)
{
    return std::max(shortest_stall, 1 / rate + overdue);
}

/// For the thread that is to run it.
std::function<void()> LoopParts::priority_request(bool above_servo)
{
    if (!settings.ask_for_priority)
    {
        return {};
    }
    return [this, above_servo] {
        const int error = ask_for_real_time(above_servo);
        if (!above_servo)
        {
            scheduling.priority_error = error;
        }
    };
}

void LoopParts::note_rendered(const RenderedTick &tick)
{
    rendered.draft() = tick;
    rendered.publish();
    saturated.store(saturated + (tick.saturated ? 1 : 0), std::memory_order_relaxed);
    held_back.store(probe.renderer().held_back(), std::memory_order_relaxed);
}

LoopReport LoopParts::run(const SceneWork &work)
{
    if (guard)
    {
        throw std::logic_error("A haptic loop runs once");
    }
    const Turn turn(*this);
    if (probe.sensor() != nullptr)
    {
        probe.sensor()->prepare_all();
    }
    run_watched(work);
    if (guard->sink_failed())
    {
        std::rethrow_exception(guard->sink_error());
    }
    return report();
}

// Before ODE does anything with them, and before the world is stepped.
void LoopParts::check_bodies()
{
    const dBodyID tool = probe.tool_body();
    std::string broken = broken_state_of(tool);
    if (broken.empty())
    {
        broken = broken_state_around(tool != nullptr ? dBodyGetFirstGeom(tool) : probe.geom());
    }
    if (!broken.empty())
    {
        throw std::runtime_error(broken);
    }
}

/// An exception that comes through ODE's own dSpaceCollide() leaves the space locked: then nothing in it may be moved or destroyed.
void LoopParts::collide(const SceneWork &work)
{
    check_bodies();
    try
    {
        work.collide();
    }
    catch (...)
    {
        if (probe.sensor() != nullptr && !is_from_safe_collide(std::current_exception()))
        {
            probe.sensor()->abandon_locked_space();
        }
        throw;
    }
    check_bodies();
}

void LoopParts::run_watched(const SceneWork &work)
{
    const StopRequest instead_of_dying; // by a signal, with the force left on
    first_time = probe.last_tick().time;
    const Watch watch(*this);
    start = clock.now();
    try
    {
        settings.decoupled ? run_decoupled(work) : run_coupled(work);
    }
    catch (const std::exception &error)
    {
        probe.renderer().relax();
        guard->post(Notice(NoticeKind::exception, now(),
                           "No force: the program's part of the loop failed: " + std::string(error.what())));
        throw;
    }
    catch (...)
    {
        probe.renderer().relax();
        guard->post(Notice(NoticeKind::exception, now(), "No force: the program's part of the loop failed."));
        throw;
    }
    if (must_end())
    {
        probe.renderer().relax();
        guard->post(Notice(NoticeKind::stop, now(), "No force: the loop was asked to end."));
    }
}

LoopReport LoopParts::report() const
{
    LoopReport report;
    report.ticks = servo.ticks();
    report.steps = settings.decoupled ? scene.ticks() : servo.ticks();
    report.period = servo.periods();
    report.compute = servo.computes();
    report.step_compute = settings.decoupled ? scene.computes() : servo.computes();
    const double elapsed = (end > 0 ? end.load() : clock.now()) - start;
    if (elapsed > 0)
    {
        report.rate = static_cast<double>(report.ticks) / elapsed;
        report.real_time_factor = simulated / elapsed;
    }
    report.overruns = servo.overruns();
    report.dropped_steps = dropped;
    report.saturated = saturated;
    report.notices = notices;
    report.held_back = held_back;
    report.scheduling = scheduling.text();
    return report;
}

HapticLoop::HapticLoop(HapticProbe &probe, LoopSettings settings)
    : parts_(std::make_unique<LoopParts>(probe, std::move(settings)))
{}

HapticLoop::~HapticLoop() = default;

LoopReport HapticLoop::run(const SceneWork &work)
{
    return parts_->run(work);
}

void HapticLoop::stop()
{
    parts_->stopped = true;
}

const RenderedTick &HapticLoop::latest() const
{
    return parts_->rendered.latest();
}

LoopReport HapticLoop::report() const
{
    return parts_->report();
}
} // namespace ode_predictive_space::haptics
