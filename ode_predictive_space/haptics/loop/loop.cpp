#include "ode_predictive_space/haptics/loop.h"

#include "ode_predictive_space/haptics/contact/scene_geoms.h"
#include "ode_predictive_space/haptics/loop/loop_parts.h"
#include "ode_predictive_space/haptics/safety/notice_desk.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double shortest_stall = 0.005;
constexpr double overdue = 0.004; // s; after the due time of the next tick

double stall_after(double rate)
{
    return std::max(shortest_stall, 1 / rate + overdue);
}

/// Guard, delivery of notices and scheduling, from the beginning of a run to its end.
class RunSupervision
{
public:
    explicit RunSupervision(LoopParts &parts) : parts_(parts), sink_(parts.probe.renderer().notice_sink())
    {
        if (parts.settings.ask_for_priority)
        {
            parts.scheduling.asked = true;
            scheduling_kept_ = keep_scheduling();
            memory_locked_ = lock_memory(parts.scheduling.memory_error);
        }
        GuardDuties duties;
        duties.stall_after = stall_after(parts.settings.rate);
        duties.scene_stall_after = stall_after(parts.settings.physics_rate);
        duties.must_end = [&parts] { return parts.stop_requested(); };
        duties.sink = [&parts, sink = parts.settings.notice ? parts.settings.notice : sink_](const Notice &notice) {
            ++parts.counts.notices;
            if (sink)
                sink(notice);
        };
        duties.time = [&parts] { return parts.now(); };
        duties.prepare = [&parts] { parts.ask_for_priority(true); };
        parts.guard = std::make_unique<LoopGuard>(parts.clock, parts.probe.renderer().gate(), std::move(duties));
        parts.probe.renderer().set_notice_sink([&parts](const Notice &notice) { parts.guard->post(notice); });
    }

    ~RunSupervision()
    {
        parts_.probe.renderer().relax();
        parts_.time.end = parts_.clock.now();
        if (parts_.probe.sensor() != nullptr)
            parts_.probe.sensor()->set_margin(0);
        if (parts_.scheduling.refused())
            parts_.notify(NoticeKind::scheduling, parts_.scheduling.text());
        parts_.guard->end();
        parts_.probe.renderer().set_notice_sink(sink_);
    }

    RunSupervision(const RunSupervision &) = delete;
    RunSupervision &operator=(const RunSupervision &) = delete;

private:
    LoopParts &parts_;
    NoticeSink sink_;
    AtEnd scheduling_kept_;
    AtEnd memory_locked_;
};

void run_coupled(LoopParts &parts, const SceneWork &work)
{
    parts.ask_for_priority(false);
    const LoopSettings &settings = parts.settings;
    const double period = 1 / settings.rate;
    double due = parts.time.start;
    for (std::uint64_t tick = 0; static_cast<double>(tick) * period < settings.duration && !parts.must_end(); ++tick)
    {
        parts.sleep_until(due);
        const double now = parts.clock.now();
        parts.guard->beat(now);
        parts.servo.begin(now);
        parts.probe.begin(parts.time.first + static_cast<double>(tick) * period, now);
        parts.collide(work);
        parts.probe.render(period);
        parts.note_rendered(parts.probe.last_tick());
        parts.rendered.take();
        work.advance(period);
        parts.time.simulated = static_cast<double>(tick + 1) * period;
        parts.counts.dropped += go_on(due, period, settings.most_steps_behind, parts.clock.now());
        parts.servo.end(parts.clock.now(), due);
    }
}

void run_watched(LoopParts &parts, const SceneWork &work)
{
    const StopRequest instead_of_dying; // a signal must not leave a force
    Renderer &renderer = parts.probe.renderer();
    parts.time.first = parts.probe.last_tick().time;
    const RunSupervision supervision(parts);
    parts.time.start = parts.clock.now();
    try
    {
        parts.settings.decoupled ? run_decoupled(parts, work) : run_coupled(parts, work);
    }
    catch (...)
    {
        renderer.relax();
        parts.notify(NoticeKind::exception, with_reason("No force: the program's part of the loop failed"));
        throw;
    }
    if (parts.must_end())
    {
        renderer.relax();
        parts.notify(NoticeKind::stop, "No force: the loop was requested to end.");
    }
}
} // namespace

HapticLoop::HapticLoop(HapticProbe &probe, LoopSettings settings)
    : parts_(std::make_unique<LoopParts>(probe, std::move(settings)))
{}

HapticLoop::~HapticLoop() = default;

/// The report is read last, because another thread may destroy the loop after that.
LoopReport HapticLoop::run(const SceneWork &work)
{
    LoopParts &parts = *parts_;
    if (parts.guard)
        throw std::logic_error("A haptic loop can run only once: make another one");
    const std::unique_lock<std::mutex> scene = parts.take_scene();
    const AtEnd turn = parts.begin_turn();
    if (parts.probe.sensor() != nullptr)
        parts.probe.sensor()->prepare_all();
    for_each_space_of(parts.probe.geom(), [](dSpaceID space) {
        if (dSpaceIsPredictive(space) != 0)
            dPredictiveSpacePrepare(space); // now, so that no tick has to wait for it
    });
    run_watched(parts, work);
    if (parts.guard->sink_failed())
        std::rethrow_exception(parts.guard->sink_error());
    return report();
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
    const LoopParts &parts = *parts_;
    const TickStatistics &scene = parts.settings.decoupled ? parts.scene : parts.servo;
    LoopReport report;
    report.ticks = parts.servo.ticks();
    report.steps = scene.ticks();
    report.period = parts.servo.periods();
    report.compute = parts.servo.computes();
    report.step_compute = scene.computes();
    const double elapsed = (parts.time.end > 0 ? parts.time.end.load() : parts.clock.now()) - parts.time.start;
    if (elapsed > 0)
    {
        report.rate = static_cast<double>(report.ticks) / elapsed;
        report.real_time_factor = parts.time.simulated / elapsed;
    }
    report.overruns = parts.servo.overruns();
    report.dropped_steps = parts.counts.dropped;
    report.saturated = parts.counts.saturated;
    report.trial_messages = parts.counts.trial_messages;
    report.notices = parts.counts.notices;
    report.scheduling = parts.scheduling.text();
    return report;
}
} // namespace ode_predictive_space::haptics
