#include "ode_predictive_space/haptics/safety.h"

#include "ode_predictive_space/haptics/device/check_argument.h"
#include "ode_predictive_space/haptics/safety/safety_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double unlimited = std::numeric_limits<double>::infinity();

template <typename... Parts> std::string sentence(const Parts &...parts)
{
    std::ostringstream text;
    text.imbue(std::locale::classic());
    (text << ... << parts);
    return text.str();
}

std::string nonsense(const Rendering &rendering)
{
    if (!is_amount(rendering.stiffness))
        return sentence("A stiffness of ", rendering.stiffness,
                        " N/m cannot be rendered: it must be finite and not negative.");
    if (!is_amount(rendering.damping))
        return sentence("A damping of ", rendering.damping,
                        " N s/m cannot be rendered: it must be finite and not negative.");
    if (!std::isfinite(rendering.rate) || rendering.rate <= 0)
        return sentence("A servo loop cannot run at ", rendering.rate, " Hz: the rate must be finite and above zero.");
    if (!is_amount(rendering.delay))
        return sentence("A delay of ", rendering.delay, " s is impossible: it must be finite and not negative.");
    if (rendering.device_damping && !is_amount(*rendering.device_damping))
        return sentence("A device with a damping of ", *rendering.device_damping,
                        " N s/m is impossible: it must be finite and not negative.");
    return "";
}

/// N/m; from max_stiffness, which holds for the nominal rate or a faster one. It implies a damping, so a delay counts
/// as a slower loop, unless the damping is known.
double stiffest_of_device(const Capabilities &capabilities, const Rendering &rendering)
{
    if (!(capabilities.max_stiffness > 0))
        return unlimited;
    if (!(rendering.delay > 0) || rendering.device_damping || !(capabilities.rate > 0))
        return capabilities.max_stiffness *
               (rendering.rate < capabilities.rate ? rendering.rate / capabilities.rate : 1);
    const double part = 1 / (capabilities.rate * (1 / rendering.rate + 2 * rendering.delay));
    return capabilities.max_stiffness * std::min(1.0, part);
}

/// N/m; by passivity, for the law's damping.
double stiffest_passive(const Rendering &rendering, double damping)
{
    if (!rendering.device_damping)
        return unlimited;
    return 2 * (*rendering.device_damping - damping) / (1 / rendering.rate + 2 * rendering.delay);
}

/// The reason of a limit, for "3000 N/m is above <reason>".
std::string bound_of(const Capabilities &capabilities, const Rendering &rendering, double most)
{
    const std::string delay =
        rendering.delay > 0 ? sentence("with a delay of ", 1000 * rendering.delay, " ms") : std::string();
    if (most < stiffest_of_device(capabilities, rendering))
        return sentence("the ", most, " N/m that are passive at ", rendering.rate, " Hz with ",
                        *rendering.device_damping, " N s/m in the device",
                        delay.empty() ? "" : " and" + delay.substr(4));
    std::string bound = sentence("the ", most, " N/m that ", capabilities.name, " can render");
    if (most < capabilities.max_stiffness)
        bound += sentence(" at ", rendering.rate, " Hz", rendering.device_damping || delay.empty() ? "" : " " + delay);
    return bound;
}
} // namespace

StabilityVerdict check_stability(const Capabilities &capabilities, const Rendering &rendering)
{
    if (const std::string wrong = nonsense(rendering); !wrong.empty())
        return {StabilityOutcome::refused, 0, 0, wrong};
    StabilityVerdict verdict{StabilityOutcome::fine, rendering.stiffness, rendering.damping, ""};
    if (capabilities.force_axes == 0)
        return verdict;

    if (const double most = capabilities.max_damping; most > 0 && verdict.damping > most)
    {
        verdict.outcome = StabilityOutcome::clamped;
        verdict.reason = sentence("A damping of ", verdict.damping, " N s/m is above the ", most, " N s/m that ",
                                  capabilities.name, " can render; ", most, " N s/m is used.");
        verdict.damping = most;
    }
    const bool pushes = verdict.stiffness > 0 || verdict.damping > 0;
    if (rendering.device_damping && pushes && !(verdict.damping < *rendering.device_damping))
    {
        return {StabilityOutcome::refused, 0, 0,
                sentence("No stiffness is passive with a damping of ", verdict.damping,
                         " N s/m, as the device's own damping, ", *rendering.device_damping, " N s/m, is not larger.")};
    }
    if (const double most = renderable(capabilities, rendering).stiffness; most < verdict.stiffness)
    {
        verdict.outcome = StabilityOutcome::clamped;
        verdict.reason +=
            sentence(verdict.reason.empty() ? "" : " ", "A stiffness of ", verdict.stiffness, " N/m is above ",
                     bound_of(capabilities, rendering, most), "; ", most, " N/m is used.");
        verdict.stiffness = most;
    }
    return verdict;
}

Rendering renderable(const Capabilities &capabilities, const Rendering &rendering) noexcept
{
    Rendering result = rendering;
    if (capabilities.force_axes == 0)
        return result;
    if (capabilities.max_damping > 0)
        result.damping = std::min(result.damping, capabilities.max_damping);
    if (rendering.device_damping && !(result.damping < *rendering.device_damping))
        result.damping = 0;
    const double stiffest =
        std::min(stiffest_of_device(capabilities, rendering), stiffest_passive(rendering, result.damping));
    result.stiffness = std::min(result.stiffness, stiffest);
    return result;
}
} // namespace ode_predictive_space::haptics
