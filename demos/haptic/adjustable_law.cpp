#include "demos/haptic/adjustable_law.h"

#include "ode_predictive_space/haptics/penalty_law.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "ode_predictive_space/haptics/recording.h"
#include "ode_predictive_space/haptics/safety.h"

namespace ode_predictive_space::demo
{
namespace
{
double stiffest_of(const haptics::Capabilities &device, double damping, double rate)
{
    haptics::Rendering rendering;
    rendering.stiffness = 1e12; // N/m; more than any device
    rendering.damping = damping;
    rendering.rate = rate;
    rendering.delay = device.delay;
    return haptics::check_stability(device, rendering).stiffness;
}

std::unique_ptr<haptics::ForceLaw> make_law(const std::string &name, const haptics::Material &surface)
{
    if (name == "proxy")
        return std::make_unique<haptics::ProxyLaw>(surface);
    return std::make_unique<haptics::PenaltyLaw>(surface);
}
} // namespace

// Recordings that name no law were made when the penalty law was the usual one.
std::string law_name(const Options &options, DemoDevice &device)
{
    const auto *replay = dynamic_cast<const haptics::ReplayDevice *>(&device.inner());
    if (replay == nullptr || options.law_given)
        return options.law;
    const std::string &recorded = replay->recording().law;
    return recorded.empty() ? "penalty" : recorded;
}

AdjustableLaw::AdjustableLaw(const std::string &name, const Options &options, double scale,
                             const haptics::Capabilities &device, double rate)
    : scale_(scale), stiffest_(stiffest_of(device, options.damping, rate)),
      law_(make_law(name, {options.stiffness / scale, options.damping / scale, options.friction})),
      wish_(options.stiffness / scale)
{}
} // namespace ode_predictive_space::demo
