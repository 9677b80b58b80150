// A tick of the hand's side: read, law, safety, write, and what there is to tell. How it is set up: renderer_setup.cpp.

#include "ode_predictive_space/haptics/renderer.h"

#include "ode_predictive_space/haptics/law/virtual_coupling.h"
#include "ode_predictive_space/haptics/renderer_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double jump = 10; // times the maximum of speed

/// Topics of notices: there is at most one notice a second on each.
enum Topic : std::size_t
{
    topic_contact,
    topic_material,
    topic_jump,
    topic_safety,                                        ///< and one for each of its actions
    topic_watchdog = topic_safety + safety_action_count, ///< and one for each of its reasons
    topic_count = topic_watchdog + watchdog_reason_count
};
static_assert(topic_count <= NoticeDesk::most_topics);

bool is_held(const std::optional<unsigned> &button, const DeviceState &state)
{
    return button && *button < 32 && ((state.buttons >> *button) & 1U) != 0;
}

/// What makes the safety stage take the force away, or less of it than one would notice.
constexpr SafetyAction worth_telling[] = {SafetyAction::not_finite, SafetyAction::too_fast, SafetyAction::waiting,
                                          SafetyAction::no_axes, SafetyAction::clamped};
} // namespace

void Renderer::read(double time, double clock_time)
{
    parts_->tick.time = time;
    parts_->notices.set_time(time);
    parts_->clock_time = clock_time;
    if (parts_->link.notice_guard() || parts_->relaxed)
        parts_->restart();
    const double delay_before = delay();
    const DeviceLink::News news =
        parts_->link.read(time, parts_->settings.rate, jump * parts_->safety.limits().max_speed);
    if (delay() > delay_before)
        parts_->tell_of_delay();
    if (parts_->link.answers())
        parts_->take_in(news);
}

void Renderer::Parts::take_in(const DeviceLink::News &news)
{
    tick.state = link.state();
    if (news.has_jumped)
    {
        ++tick.tool_jumps;
        restart();
        notices.tell_once_a_second(topic_jump, NoticeKind::device,
                                   "No force until the probe is free: the device's position has jumped.");
    }
    if (news.came_back)
        news.only_doubted ? safety.restart_ramp() : restart();
    if (news.had_failed)
        notices.tell(NoticeKind::device, link.capabilities().name + " answers again; the force comes back slowly.");
    if (news.was_away)
        ++tick.tool_jumps;
    move_clutch();
    tick.tool = mapping.to_scene(tick.state);
}

// Where the clutch is let go, the tool may be deep in something: no force jumps at the hand.
void Renderer::Parts::move_clutch()
{
    const bool was_held = mapping.clutched();
    mapping.clutch(is_held(settings.clutch_button, tick.state), tick.state);
    if (was_held && !mapping.clutched())
        safety.reset();
}

/// What is rendered from now on is as soft as the delay wants it: rendered() goes by that. The law itself is not changed.
void Renderer::Parts::tell_of_delay()
{
    const Material material = law->material();
    const StabilityVerdict verdict =
        check_stability(link.capabilities(), rendering(material.stiffness, material.damping));
    if (verdict.outcome != StabilityOutcome::fine)
        notices.tell(NoticeKind::stability, verdict.reason);
}

void Renderer::Parts::restart()
{
    relaxed = false;
    safety.reset();
    law->reset();
    felt.manifold.reset();
    felt.split.clear();
    link.forget_motion();
    if (passivity)
        passivity->reset();
}

void Renderer::relax() noexcept
{
    parts_->felt.split.clear();
    parts_->link.release();
    parts_->relaxed = true;
}

void Renderer::render(const std::vector<Touch> &touches, bool all_known, double dt)
{
    FeltTouches &felt = parts_->felt;
    parts_->feel(touches, dt);
    parts_->law->forces(tool(), felt.touches, dt, felt.forces);
    Wrench requested;
    requested.force = sum_of(felt.forces);
    if (!all_known)
    {
        requested.force.setConstant(std::numeric_limits<double>::quiet_NaN());
        parts_->notices.tell_once_a_second(
            topic_contact, NoticeKind::contact,
            "No force: a contact of the probe, or the velocity of what it touches, is not a number.");
    }
    const Vector3 given = parts_->write(requested, dt).force;
    if (given.isZero(0))
        felt.split.clear();
    else
        felt.split.split(felt.touches, felt.forces, given);
    parts_->close_tick(requested.force, given);
}

/// The touches as they are rendered: with what the device can render of their materials.
void Renderer::Parts::feel(const std::vector<Touch> &touches, double dt)
{
    felt.touches = touches;
    bool less = false;
    for (Touch &touch : felt.touches)
    {
        const Material asked = touch.material.value_or(law->material());
        const Material possible = rendered(asked);
        less = less || (touch.material && (possible.stiffness < asked.stiffness || possible.damping < asked.damping));
        touch.material = possible;
    }
    if (less)
    {
        notices.tell_once_a_second(
            topic_material, NoticeKind::stability,
            "A material is softer or less damped than asked for: the device cannot render more.");
    }
    std::optional<double> gap;
    if (safety.engaged())
        gap = std::max(dt, 1 / settings.physics_rate);
    felt.manifold.follow(tick.tool, law->view(), dt, gap, felt.touches);
}

Wrench Renderer::render(const CouplingProperties &coupling, const ToolState &body, double dt)
{
    CouplingProperties softened = coupling;
    softened.stiffness = rendered({coupling.stiffness, coupling.damping}).stiffness;
    const Wrench requested = wrench_on_device(softened, tool(), body);
    Wrench given = parts_->write(requested, dt);
    if (parts_->link.capabilities().force_axes < 6 && parts_->link.answers())
        given.torque = parts_->watchdog->factor() * requested.torque;
    parts_->close_tick(requested.force, given.force);
    return {-given.force, -given.torque};
}

/// @return what was written, in the scene's frame.
Wrench Renderer::Parts::write(const Wrench &requested, double dt)
{
    watchdog->device_answered(link.answers());
    watchdog->servo_ticked(clock_time);
    tick.wrench = link.answers() ? link.write(limited(requested, dt)) : Wrench();
    tell_of_watchdog();
    notices.tell_held_back();
    if (passivity)
        passivity->written(tick.wrench.force);
    const WorkspacePlacement &placement = mapping.placement();
    return {placement.rotation * tick.wrench.force / placement.force_scale,
            placement.rotation * tick.wrench.torque / placement.force_scale};
}

Wrench Renderer::Parts::limited(const Wrench &requested, double dt)
{
    Wrench at_device = mapping.to_device(requested);
    if (passivity && !mapping.clutched())
    {
        passivity->set_delay(static_cast<int>(std::lround(
            std::min(1.0, delay() / dt / PassivityController::most_delay) * PassivityController::most_delay)));
        at_device.force = passivity->control(tick.state, at_device.force, dt);
    }
    Vector3 velocity = tick.state.linear_velocity;
    if (link.speed() > safety.limits().max_speed) // whatever the device tells
        velocity = link.speed() * Vector3::UnitX();
    Wrench safe = safety.limit(at_device, velocity, tick.time, watchdog->factor());
    tell_of_safety();
    return safe;
}

void Renderer::Parts::close_tick(const Vector3 &requested, const Vector3 &force)
{
    tick.wished = requested;
    tick.force = force;
    tick.allowance = watchdog->factor();
    tick.device_answers = link.answers();
    tick.saturated = link.answers() && safety.report().did(SafetyAction::clamped);
    if (recorder)
        recorder(tick);
}

void Renderer::Parts::tell_of_safety()
{
    for (const SafetyAction action : worth_telling)
    {
        if (safety.report().began(action))
        {
            notices.tell_once_a_second(topic_safety + static_cast<std::size_t>(action), NoticeKind::safety,
                                       explanation_of(action));
        }
    }
}

// A device that does not answer has been told of.
void Renderer::Parts::tell_of_watchdog()
{
    const WatchdogReason reason = watchdog->reason();
    const bool worth = reason == WatchdogReason::physics_stale || reason == WatchdogReason::servo_late;
    if (worth && reason != last_reason && !link.guard_acted()) // of that, the guard has told
    {
        notices.tell_once_a_second(topic_watchdog + static_cast<std::size_t>(reason), NoticeKind::watchdog,
                                   explanation_of(reason));
    }
    last_reason = reason;
}

void Renderer::note_fresh_physics()
{
    physics_fresh(parts_->clock_time);
}

void Renderer::physics_fresh(double clock_time)
{
    parts_->watchdog->physics_fresh(clock_time);
}

void Renderer::tell_held_back()
{
    parts_->notices.tell_all_held_back();
}

const ToolState &Renderer::tool() const
{
    return parts_->tick.tool;
}

const std::vector<ForceShare> &Renderer::shares() const
{
    return parts_->felt.split.shares();
}

const RenderedTick &Renderer::last_tick() const
{
    return parts_->tick;
}

const SafetyReport &Renderer::safety_report() const
{
    return parts_->safety.report();
}

std::uint64_t Renderer::held_back() const
{
    return parts_->notices.held_back();
}

DeviceGate &Renderer::gate()
{
    return parts_->link.gate();
}
} // namespace ode_predictive_space::haptics
