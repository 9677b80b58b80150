// How stiff a wall a device can render without shaking.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_STABILITY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_STABILITY_H

#include "ode_predictive_space/haptics/device.h"

#include <optional>

namespace ode_predictive_space::haptics
{
/// What is rendered, and how, as the device sees it (with a workspace mapping of scale s, a law's values times s).
struct Rendering
{
    double stiffness = 0; ///< N/m; K
    double damping = 0;   ///< N s/m; B, of the law
    double rate = 1000;   ///< Hz; of the servo loop, 1 / T
    double delay = 0;     ///< s; from reading a position to the force that answers it, beyond the loop's own period
    std::optional<double> device_damping; ///< N s/m; b, of the device and the hand that holds it, where it is known
};

/// Whether a material can be rendered as it was asked for.
enum class StabilityOutcome
{
    fine,    ///< as it was asked for
    clamped, ///< stiffness or damping are to be less
    refused  ///< nothing sensible can be rendered: nonsense was asked for
};

/// What is rendered in place of a material that was asked for.
struct StabilityVerdict
{
    StabilityOutcome outcome = StabilityOutcome::fine; ///< how it differs from what was asked for
    double stiffness = 0;                              ///< N/m; to be used
    double damping = 0;                                ///< N s/m; to be used
    std::string reason;                                ///< one sentence: why not as asked; empty when fine
};

/// Compares what is to be rendered with what the device can do.
///
/// A sampled wall of stiffness K and damping B, held from tick to tick, is passive, whatever the hand does, if and only if
///
///     b > K T / 2 + |B|
///
/// with b the device's own damping (Colgate and Schenkel, "Passivity of a class of sampled-data systems", 1997). A further delay D
/// lags the force as half a period does: b > K (T / 2 + D) + |B|. Hence K is at most 2 (b - |B|) / (T + 2 D), which is 2 b / T for
/// a plain spring. Besides, K is at most the device's max_stiffness, B at most its max_damping, if they are known (above 0); the
/// former holds for the device's nominal rate, and is less in proportion when the loop is slower.
///
/// Without a known b, only the device's limits count: they were found by trial with a hand that damps, and without delay. Then a
/// delay makes K less as it does above: at most max_stiffness T0 / (T + 2 D), with T0 the device's nominal period.
StabilityVerdict check_stability(const Capabilities &capabilities, const Rendering &rendering);

/// The same without words, for where something has to be rendered: neither allocates nor throws. Damping that nothing would make passive
/// becomes none.
///
/// @return what may be rendered; its stiffness and damping are those asked for, or less.
Rendering renderable(const Capabilities &capabilities, const Rendering &rendering) noexcept;
} // namespace ode_predictive_space::haptics

#endif
