// How the hand's side of a probe is set up, and what the device can bear of what is asked for.

#include "ode_predictive_space/haptics/contact/short_list.h"
#include "ode_predictive_space/haptics/device/check_argument.h"
#include "ode_predictive_space/haptics/law/virtual_coupling.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "ode_predictive_space/haptics/renderer_parts.h"

#include <stdexcept>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double usual_stiffness = 500; // N/m

/// As stiff in the hand, whatever the scale.
std::shared_ptr<ForceLaw> usual_law(const Capabilities &capabilities, const WorkspaceMapping &mapping)
{
    Material material;
    const double stiffness = capabilities.max_stiffness > 0 ? capabilities.max_stiffness / 2 : usual_stiffness;
    material.stiffness = mapping.stiffness_in_scene(stiffness);
    return std::make_shared<ProxyLaw>(material);
}

// With a device that cannot push, one can still push what is in the scene, as hard as with any other.
SafetyLimits usual_limits(const Capabilities &capabilities)
{
    if (capabilities.force_axes > 0)
        return SafetyLimits::of(capabilities);
    Capabilities desktop = capabilities;
    desktop.force_axes = 3;
    desktop.max_force = 7.9; // N; a PHANToM Desktop
    return SafetyLimits::of(desktop);
}
} // namespace

Renderer::Parts::Parts(Device &device, RenderSettings render_settings)
    : settings(std::move(render_settings)), notices(settings.notice), link(device, notices),
      mapping(settings.placement), law(settings.law ? settings.law : usual_law(device.capabilities(), mapping)),
      safety(settings.safety ? *settings.safety : usual_limits(device.capabilities()))
{
    felt.forces.reserve(usual_touches);
    felt.touches.reserve(usual_touches);
    if (settings.passivity_control)
        passivity.emplace(device.capabilities().max_damping);
    if (settings.delay && !is_amount(*settings.delay))
        throw std::invalid_argument("The delay of a device must be finite and not negative");
}

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
    parts_->mapping = WorkspaceMapping(placement);
    if (!parts_->settings.law)
        parts_->law = usual_law(parts_->link.capabilities(), parts_->mapping);
    parts_->check_law();
    parts_->restart(); // the tool jumps, perhaps into something
    ++parts_->tick.tool_jumps;
}

const WorkspaceMapping &Renderer::mapping() const
{
    return parts_->mapping;
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

void Renderer::Parts::check(double stiffness, double damping)
{
    const Rendering wanted = rendering(stiffness, damping);
    const StabilityVerdict verdict = check_stability(link.capabilities(), wanted);
    if (verdict.outcome == StabilityOutcome::refused || verdict.damping < wanted.damping)
        throw std::invalid_argument(verdict.reason);
    if (verdict.outcome == StabilityOutcome::clamped && verdict.reason != stability_told)
        notices.tell(NoticeKind::stability, verdict.reason);
    stability_told = verdict.reason;
}

/// @param stiffness,damping of the scene.
Rendering Renderer::Parts::rendering(double stiffness, double damping) const
{
    Rendering rendering;
    rendering.stiffness = mapping.stiffness_at_device(stiffness);
    rendering.damping = mapping.stiffness_at_device(damping);
    rendering.rate = settings.rate;
    rendering.device_damping = settings.device_damping;
    rendering.delay = delay();
    return rendering;
}

double Renderer::delay() const
{
    return parts_->delay();
}

Material Renderer::Parts::rendered(const Material &material) const
{
    const Rendering wanted = rendering(material.stiffness, material.damping);
    const Rendering possible = renderable(link.capabilities(), wanted);
    Material result = material;
    if (possible.stiffness < wanted.stiffness)
        result.stiffness = mapping.stiffness_in_scene(possible.stiffness);
    if (possible.damping < wanted.damping)
        result.damping = mapping.stiffness_in_scene(possible.damping);
    return result;
}

Material Renderer::rendered(const Material &material) const
{
    return parts_->rendered(material);
}
} // namespace ode_predictive_space::haptics
