#include "ode_predictive_space/haptics/loop/loop_parts.h"

#include "ode_predictive_space/haptics/contact/safe_collide.h"
#include "ode_predictive_space/haptics/safety.h"
#include "ode_predictive_space/haptics/touch_sensor.h"

#include <stdexcept>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
LoopSettings checked(LoopSettings settings, HapticProbe &probe)
{
    if (probe.is_taken())
        throw std::logic_error("Another haptic loop uses the probe");
    if (!settings.decoupled)
        settings.physics_rate = settings.rate;
    if (settings.decoupled && probe.sensor() == nullptr)
    {
        throw std::invalid_argument(
            "A decoupled loop cannot render a tool body, which moves only in the scene's step: use a loop in one "
            "thread");
    }
    if (settings.physics_rate > settings.rate || settings.most_steps_behind < 0 || !(settings.margin >= 0))
    {
        throw std::invalid_argument(
            "A loop's physics_rate must not be above its rate, and most_steps_behind and margin must not be negative");
    }
    probe.renderer().set_rates(settings.rate, settings.physics_rate);
    return settings;
}
} // namespace

LoopParts::LoopParts(HapticProbe &haptic_probe, LoopSettings loop_settings)
    : probe(haptic_probe), settings(checked(std::move(loop_settings), haptic_probe)),
      clock(settings.clock != nullptr ? *settings.clock : machine_clock)
{}

std::unique_lock<std::mutex> LoopParts::take_scene()
{
    return settings.scene != nullptr ? std::unique_lock(*settings.scene) : std::unique_lock<std::mutex>();
}

void LoopParts::sleep_until(double time)
{
    if (settings.scene != nullptr)
        settings.scene->unlock();
    clock.sleep_until(time);
    if (settings.scene != nullptr)
        settings.scene->lock();
}

AtEnd LoopParts::begin_turn()
{
    const auto run = std::make_shared<ActiveRun>();
    probe.take(run);
    std::atomic_store(&run_, run);
    bodies_.emplace(scene_geom());
    return AtEnd([run, this] {
        bodies_.reset();
        probe.give_back();
        run->end();
    });
}

LoopParts::~LoopParts()
{
    if (const std::shared_ptr<ActiveRun> run = std::atomic_load(&run_))
        run->end_and_wait("a haptic loop");
}

bool LoopParts::stop_requested() const
{
    return stopped.load(std::memory_order_relaxed) || run_->stop_requested() || StopRequest::requested();
}

bool LoopParts::must_end() const
{
    return stop_requested() || guard->sink_failed();
}

void LoopParts::ask_for_priority(bool above_servo)
{
    const int error = settings.ask_for_priority ? ask_for_real_time(above_servo) : 0;
    if (!above_servo)
        scheduling.priority_error = error;
}

void LoopParts::note_rendered(const RenderedTick &tick)
{
    rendered.draft() = tick;
    rendered.publish();
    counts.saturated += tick.saturated ? 1 : 0;
}

dGeomID LoopParts::scene_geom() const
{
    const dBodyID tool = probe.tool_body();
    return tool != nullptr ? dBodyGetFirstGeom(tool) : probe.geom();
}

void LoopParts::check_bodies()
{
    const std::string broken = bodies_->broken_state(probe.tool_body(), scene_geom());
    if (!broken.empty())
        throw std::runtime_error(broken);
}

/// An exception through ODE's own dSpaceCollide() leaves the space locked, so that its geoms must not be moved or destroyed.
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
            probe.sensor()->abandon_locked_space();
        throw;
    }
    check_bodies();
}
} // namespace ode_predictive_space::haptics
