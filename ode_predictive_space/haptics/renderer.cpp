// Stages of a tick: read, law, safety, write, and notices.

#include "ode_predictive_space/haptics/renderer.h"

#include "ode_predictive_space/haptics/device/check_argument.h"
#include "ode_predictive_space/haptics/device/hand_workspace.h"
#include "ode_predictive_space/haptics/law/rendered_touches.h"
#include "ode_predictive_space/haptics/law/virtual_coupling.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "ode_predictive_space/haptics/safety/device_link.h"
#include "ode_predictive_space/haptics/safety/passivity.h"
#include "ode_predictive_space/haptics/safety/safety_stage.h"
#include "ode_predictive_space/haptics/safety/watchdog.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double usual_stiffness = 500; // N/m

/// N s/m; damping of device and hand in a light grip (some 80 g and 60 N/m). Devices do not report theirs.
constexpr double light_grip = 0.8;
/// Factor for encoders: at 0.75 of the passive stiffness, such a grip oscillates by two encoder steps.
constexpr double margin_of_encoders = 0.6;

/// The stiffness in the hand does not depend on the scale. If the damping is unknown, it is limited to the stable
/// stiffness of a light grip.
std::shared_ptr<ForceLaw> usual_law(const Capabilities &capabilities, const WorkspaceMapping &mapping,
                                    const RenderSettings &settings)
{
    double stiffness = capabilities.max_stiffness > 0 ? capabilities.max_stiffness / 2 : usual_stiffness;
    if (!settings.device_damping && settings.rate > 0)
    {
        const double late = 1 / settings.rate + 2 * settings.delay.value_or(capabilities.delay); // s
        stiffness = std::min(stiffness, margin_of_encoders * 2 * light_grip / late);
    }
    Material material;
    material.stiffness = mapping.stiffness_in_scene(stiffness);
    return std::make_shared<ProxyLaw>(material);
}

// A device without force output still pushes the scene, with the limits of a common device.
SafetyLimits usual_limits(const Capabilities &capabilities)
{
    if (capabilities.force_axes > 0)
        return SafetyLimits::of(capabilities);
    Capabilities desktop = capabilities;
    desktop.force_axes = 3;
    desktop.max_force = 7.9; // N; a PHANToM Desktop
    return SafetyLimits::of(desktop);
}

constexpr double jump = 10; // of the maximum speed

bool is_held(const std::optional<unsigned> &button, const DeviceState &state)
{
    return button && *button < 32 && ((state.buttons >> *button) & 1U) != 0;
}
} // namespace

class Renderer::Parts
{
public:
    Parts(Device &device, RenderSettings render_settings)
        : settings(std::move(render_settings)), notices(settings.notice), link(device, notices),
          workspace(settings.placement),
          law(settings.law ? settings.law : usual_law(device.capabilities(), workspace.mapping, settings)),
          safety(settings.safety ? *settings.safety : usual_limits(device.capabilities()))
    {
        if (settings.passivity_control)
            passivity.emplace(device.capabilities().max_damping);
        if (settings.delay && !is_amount(*settings.delay))
            throw std::invalid_argument("The delay of a device must be finite and not negative");
    }

    double delay() const { return settings.delay.value_or(link.capabilities().delay); }

    void restart()
    {
        relaxed = false;
        safety.reset();
        law->reset();
        touched.reset();
        link.forget_motion();
        if (passivity)
            passivity->reset();
    }

    void take_in(const DeviceLink::News &news)
    {
        tick.state = link.state();
        if (news.has_jumped)
        {
            ++tick.tool_jumps;
            restart();
            notices.notify_once_a_second(NoticeKind::device,
                                         "No force until the probe is free, as the device's position has jumped.");
        }
        if (news.came_back)
            news.only_doubted ? safety.restart_ramp() : restart();
        if (news.had_failed)
            notices.notify(NoticeKind::device, link.capabilities().name + " answers again; the force grows slowly.");
        if (news.was_away)
            ++tick.tool_jumps;
        workspace.move_clutch(is_held(settings.clutch_button, tick.state), tick.state);
        tick.tool = workspace.mapping.to_scene(tick.state);
    }

    void render(const std::vector<Touch> &touches, bool all_known, double dt)
    {
        choose_materials(touched.take(touches));
        std::optional<double> gap;
        if (safety.engaged())
            gap = std::max(dt, 1 / settings.physics_rate);
        Wrench requested;
        requested.force = touched.force(*law, tick.tool, dt, gap, workspace.take_release());
        if (!all_known)
        {
            requested.force.setConstant(std::numeric_limits<double>::quiet_NaN());
            notices.notify_once_a_second(
                NoticeKind::contact,
                "No force: a contact of the probe, or the velocity of a touched body, is not a number.");
        }
        const Vector3 given = write(requested, dt).force;
        touched.give(given);
        close_tick(requested.force, given);
    }

    void choose_materials(std::vector<Touch> &touches)
    {
        bool less = false;
        for (Touch &touch : touches)
        {
            const Material asked = touch.material.value_or(law->material());
            const Material possible = rendered(asked);
            less =
                less || (touch.material && (possible.stiffness < asked.stiffness || possible.damping < asked.damping));
            touch.material = possible;
        }
        if (less)
        {
            notices.notify_once_a_second(
                NoticeKind::stability,
                "A material is softer or less damped than requested, as the device cannot render more.");
        }
    }

    Wrench write(const Wrench &requested, double dt)
    {
        watchdog->device_answered(link.answers());
        watchdog->servo_ticked(clock_time);
        tick.wrench = link.answers() ? link.write(limited(requested, dt)) : Wrench();
        notify_of_watchdog();
        if (passivity)
            passivity->written(tick.wrench.force);
        const WorkspacePlacement &placement = workspace.mapping.placement();
        return {placement.rotation * tick.wrench.force / placement.force_scale,
                placement.rotation * tick.wrench.torque / placement.force_scale};
    }

    Wrench limited(const Wrench &requested, double dt)
    {
        Wrench at_device = workspace.mapping.to_device(requested);
        if (passivity && !workspace.mapping.clutched())
        {
            passivity->set_delay(delay() / dt);
            at_device.force = passivity->control(tick.state, at_device.force, dt);
        }
        Vector3 velocity = tick.state.linear_velocity;
        if (link.speed() > safety.limits().max_speed) // the measured speed counts
            velocity = link.speed() * Vector3::UnitX();
        Wrench safe = safety.limit(at_device, velocity, tick.time, watchdog->factor());
        notify_of_safety();
        return safe;
    }

    void close_tick(const Vector3 &requested, const Vector3 &force)
    {
        tick.requested = requested;
        tick.force = force;
        tick.allowance = watchdog->factor();
        tick.device_answers = link.answers();
        tick.saturated = link.answers() && safety.report().did(SafetyAction::clamped);
        if (recorder)
            recorder(tick);
    }

    void notify_of_safety()
    {
        for (const SafetyAction action : explained_actions)
            if (safety.report().began(action))
                notices.notify_once_a_second(NoticeKind::safety, explanation_of(action));
    }

    void notify_of_watchdog()
    {
        const char *const explanation = explanation_of(watchdog->reason());
        if (explanation != nullptr && watchdog->has_new_reason() && !link.guard_acted()) // the guard has reported that
            notices.notify_once_a_second(NoticeKind::watchdog, explanation);
    }

    void renew_usual_law()
    {
        if (!settings.law)
            law = usual_law(link.capabilities(), workspace.mapping, settings);
    }

    void check_law() { check(law->material().stiffness, law->material().damping); }

    void check(double stiffness, double damping)
    {
        const Rendering wanted = rendering(stiffness, damping);
        const StabilityVerdict verdict = check_stability(link.capabilities(), wanted);
        if (verdict.outcome == StabilityOutcome::refused || verdict.damping < wanted.damping)
            throw std::invalid_argument(verdict.reason);
        if (verdict.outcome == StabilityOutcome::clamped && verdict.reason != reported_reason)
            notices.notify(NoticeKind::stability, verdict.reason);
        reported_reason = verdict.reason;
    }

    Rendering rendering(double stiffness, double damping) const
    {
        Rendering rendering;
        rendering.stiffness = workspace.mapping.stiffness_at_device(stiffness);
        rendering.damping = workspace.mapping.stiffness_at_device(damping);
        rendering.rate = settings.rate;
        rendering.device_damping = settings.device_damping;
        rendering.delay = delay();
        return rendering;
    }

    Material rendered(const Material &material) const
    {
        const Rendering wanted = rendering(material.stiffness, material.damping);
        const Rendering possible = renderable(link.capabilities(), wanted);
        Material result = material;
        if (possible.stiffness < wanted.stiffness)
            result.stiffness = workspace.mapping.stiffness_in_scene(possible.stiffness);
        if (possible.damping < wanted.damping)
            result.damping = workspace.mapping.stiffness_in_scene(possible.damping);
        return result;
    }

    RenderSettings settings; ///< law is 0 for the default law
    NoticeDesk notices;
    DeviceLink link;
    HandWorkspace workspace;
    std::shared_ptr<ForceLaw> law;
    SafetyStage safety;
    std::optional<Watchdog> watchdog; ///< replaced with the rates; has a value after construction
    std::optional<PassivityController> passivity;
    std::function<void(const RenderedTick &)> recorder;
    RenderedTouches touched;
    RenderedTick tick;
    double clock_time = 0;
    bool relaxed = false;        ///< without a read() since
    std::string reported_reason; ///< the reported reason for a softer law
};

Renderer::Renderer(Device &device, RenderSettings settings)
    : parts_(std::make_unique<Parts>(device, std::move(settings)))
{
    set_rates(parts_->settings.rate, parts_->settings.physics_rate);
}

Renderer::~Renderer()
{
    relax();
}

void Renderer::set_rates(double rate, double physics_rate)
{
    if (!(rate > 0) || !(physics_rate > 0))
        throw std::invalid_argument("The rates of a servo loop and of its scene must be above 0");
    parts_->settings.rate = rate;
    parts_->settings.physics_rate = physics_rate;
    parts_->renew_usual_law();
    parts_->watchdog.emplace(WatchdogLimits::of(rate, physics_rate));
    parts_->check_law();
}

void Renderer::set_law(std::shared_ptr<ForceLaw> law)
{
    parts_->law = std::move(law);
    parts_->settings.law = parts_->law;
    parts_->check_law();
    parts_->law->reset();
}

ForceLaw &Renderer::law()
{
    return *parts_->law;
}

void Renderer::set_placement(const WorkspacePlacement &placement)
{
    parts_->workspace.place(placement);
    parts_->renew_usual_law();
    parts_->check_law();
    parts_->restart(); // the tool jumps
    ++parts_->tick.tool_jumps;
}

void Renderer::move_base(const WorkspacePlacement &placement, const BaseMotion &motion)
{
    parts_->workspace.aim(placement, motion);
}

const WorkspaceMapping &Renderer::mapping() const
{
    return parts_->workspace.mapping;
}

void Renderer::set_recorder(std::function<void(const RenderedTick &)> recorder)
{
    parts_->recorder = std::move(recorder);
}

void Renderer::set_notice_sink(NoticeSink sink)
{
    parts_->notices.set_sink(std::move(sink));
}

const NoticeSink &Renderer::notice_sink() const
{
    return parts_->notices.sink();
}

void Renderer::check(const CouplingProperties &coupling)
{
    haptics::check(coupling);
    parts_->check(coupling.stiffness, coupling.damping);
}

Material Renderer::rendered(const Material &material) const
{
    return parts_->rendered(material);
}

void Renderer::read(double time, double clock_time)
{
    parts_->workspace.move_base(time - parts_->tick.time, 1 / parts_->settings.physics_rate);
    parts_->tick.time = time;
    parts_->notices.set_time(time);
    parts_->clock_time = clock_time;
    if (parts_->link.notice_guard() || parts_->relaxed)
        parts_->restart();
    const DeviceLink::News news =
        parts_->link.read(time, parts_->settings.rate, jump * parts_->safety.limits().max_speed);
    if (parts_->link.answers())
        parts_->take_in(news);
}

void Renderer::relax() noexcept
{
    parts_->touched.give(Vector3::Zero());
    parts_->link.gate().release();
    parts_->relaxed = true;
}

void Renderer::render(const std::vector<Touch> &touches, bool all_known, double dt)
{
    parts_->render(touches, all_known, dt);
}

Wrench Renderer::render(const CouplingProperties &coupling, const ToolState &body, double dt)
{
    CouplingProperties softened = coupling;
    softened.stiffness = rendered({coupling.stiffness, coupling.damping}).stiffness;
    const Wrench requested = wrench_on_device(softened, tool(), body);
    if (parts_->workspace.take_release())
        parts_->safety.restart_ramp(); // the body may be far from the tool
    Wrench given = parts_->write(requested, dt);
    if (parts_->link.capabilities().force_axes < 6 && parts_->link.answers())
        given.torque = parts_->watchdog->factor() * requested.torque;
    parts_->close_tick(requested.force, given.force);
    return {-given.force, -given.torque};
}

void Renderer::note_fresh_physics()
{
    physics_fresh(parts_->clock_time);
}

void Renderer::physics_fresh(double clock_time)
{
    parts_->watchdog->physics_fresh(clock_time);
}

const ToolState &Renderer::tool() const
{
    return parts_->tick.tool;
}

const std::vector<ForceShare> &Renderer::shares() const
{
    return parts_->touched.shares();
}

const RenderedTick &Renderer::last_tick() const
{
    return parts_->tick;
}

DeviceGate &Renderer::gate()
{
    return parts_->link.gate();
}
} // namespace ode_predictive_space::haptics
