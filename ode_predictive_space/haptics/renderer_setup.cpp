// How the hand's side of a probe is set up, and what the device can bear of what is asked for.

#include "ode_predictive_space/haptics/contact/contact_manifold.h"
#include "ode_predictive_space/haptics/contact/usual_touches.h"
#include "ode_predictive_space/haptics/device/check_argument.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "ode_predictive_space/haptics/renderer.h"
#include "ode_predictive_space/haptics/safety/open_gates.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double never = -std::numeric_limits<double>::infinity();
constexpr double usual_stiffness = 500; // N/m
constexpr double usual_rate = 1000;     // Hz

/// As stiff in the hand, whatever the scale.
std::shared_ptr<ForceLaw> usual_law(const Capabilities &capabilities, const WorkspaceMapping &mapping)
{
    Material material;
    const double stiffness = capabilities.max_stiffness > 0 ? capabilities.max_stiffness / 2 : usual_stiffness;
    material.stiffness = mapping.stiffness_in_scene(stiffness);
    return std::make_shared<ProxyLaw>(material);
}

double rate_of(const Capabilities &capabilities)
{
    return capabilities.rate > 0 ? capabilities.rate : usual_rate;
}

// With a device that cannot push, one can still push what is in the scene, as hard as with any other.
SafetyLimits usual_limits(const Capabilities &capabilities)
{
    if (capabilities.force_axes > 0)
    {
        return SafetyLimits::of(capabilities);
    }
    Capabilities desktop = capabilities;
    desktop.force_axes = 3;
    desktop.max_force = 7.9; // N; a PHANToM Desktop
    return SafetyLimits::of(desktop);
}
} // namespace

Renderer::Opening::Opening(Device &device) : device_(device), opened_(!device.status().open)
{
    if (opened_)
    {
        device_.open();
    }
}

Renderer::Opening::~Opening()
{
    if (opened_)
    {
        device_.close();
    }
}

Renderer::Registration::Registration(DeviceGate &gate) : gate_(gate)
{
    open_gates::add(gate_);
}

Renderer::Registration::~Registration()
{
    open_gates::remove(gate_);
}

Renderer::Renderer(Device &device, RenderSettings settings)
    : gate_(device), opening_(device), registration_(gate_), settings_(std::move(settings)),
      mapping_(settings_.placement), law_(settings_.law ? settings_.law : usual_law(device.capabilities(), mapping_)),
      safety_(settings_.safety ? *settings_.safety : usual_limits(device.capabilities())), doubted_since_(never),
      next_try_(never), last_state_time_(std::numeric_limits<double>::quiet_NaN()), last_answer_(never),
      manifold_(std::make_unique<ContactManifold>()), motion_(rate_of(device.capabilities()))
{
    told_.fill({never, 0, {}});
    forces_.reserve(usual_touches);
    felt_.reserve(usual_touches);
    if (settings_.passivity_control)
    {
        passivity_.emplace(device.capabilities().max_damping);
    }
    if (settings_.delay && !is_amount(*settings_.delay))
    {
        throw std::invalid_argument("The delay of a device must be finite and not negative");
    }
    set_rates(settings_.rate, settings_.physics_rate);
}

Renderer::~Renderer()
{
    relax();
}

void Renderer::set_rates(double rate, double physics_rate)
{
    if (!(rate > 0) || !(physics_rate > 0))
    {
        throw std::invalid_argument("The rates of a servo loop and of its scene must be above 0");
    }
    settings_.rate = rate;
    settings_.physics_rate = physics_rate;
    watchdog_.emplace(WatchdogLimits::of(rate, physics_rate));
    check_law();
}

void Renderer::set_law(std::shared_ptr<ForceLaw> law)
{
    law_ = std::move(law);
    settings_.law = law_;
    check_law();
    law_->reset();
}

void Renderer::set_placement(const WorkspacePlacement &placement)
{
    mapping_ = WorkspaceMapping(placement);
    if (!settings_.law)
    {
        law_ = usual_law(gate_.device().capabilities(), mapping_);
    }
    check_law();
    begin_anew(); // the tool jumps, perhaps into something
    ++tick_.tool_jumps;
}

void Renderer::check_law()
{
    const Material material = law_->material();
    check(material.stiffness, material.damping);
}

void Renderer::check(const VirtualCoupling &coupling)
{
    check(coupling.stiffness(), coupling.damping());
}

VirtualCoupling Renderer::softened(VirtualCoupling coupling) const
{
    coupling.set_stiffness(rendered({coupling.stiffness(), coupling.damping()}).stiffness);
    return coupling;
}

/// @param stiffness,damping of the scene.
Rendering Renderer::rendering(double stiffness, double damping) const
{
    Rendering rendering;
    rendering.stiffness = mapping_.stiffness_at_device(stiffness);
    rendering.damping = mapping_.stiffness_at_device(damping);
    rendering.rate = settings_.rate;
    rendering.device_damping = settings_.device_damping;
    rendering.delay = delay();
    return rendering;
}

double Renderer::delay() const
{
    return std::max(settings_.delay.value_or(gate_.device().capabilities().delay), delay_meter_.delay());
}

void Renderer::check(double stiffness, double damping)
{
    const Rendering wanted = rendering(stiffness, damping);
    const StabilityVerdict verdict = check_stability(gate_.device().capabilities(), wanted);
    if (verdict.outcome == StabilityOutcome::refused || verdict.damping < wanted.damping)
    {
        throw std::invalid_argument(verdict.reason);
    }
    if (verdict.outcome == StabilityOutcome::clamped && verdict.reason != stability_told_)
    {
        tell(NoticeKind::stability, verdict.reason);
    }
    stability_told_ = verdict.reason;
}

Material Renderer::rendered(const Material &material) const
{
    const Rendering wanted = rendering(material.stiffness, material.damping);
    const Rendering possible = renderable(gate_.device().capabilities(), wanted);
    Material result = material;
    if (possible.stiffness < wanted.stiffness)
    {
        result.stiffness = mapping_.stiffness_in_scene(possible.stiffness);
    }
    if (possible.damping < wanted.damping)
    {
        result.damping = mapping_.stiffness_in_scene(possible.damping);
    }
    return result;
}
} // namespace ode_predictive_space::haptics
