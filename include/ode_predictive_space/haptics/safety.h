// What keeps the hand safe, as programs see it: notices, limits, what can be rendered stably, and requests to stop.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SAFETY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SAFETY_H

#include "ode_predictive_space/haptics/device.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ode_predictive_space::haptics
{
/// What a notice is about.
enum class NoticeKind
{
    device,     ///< a device failed, or is back
    contact,    ///< a contact is not a number, or a mesh is still being read
    safety,     ///< the safety stage takes the force away or clamps it
    watchdog,   ///< something does not keep up: the force decays
    stability,  ///< what was asked for is too stiff for the device
    guard,      ///< the loop hung: its guard has taken the force away
    exception,  ///< the program's callback threw
    stop,       ///< the loop was asked to end
    scheduling, ///< the system refused what makes a loop punctual
    coupling    ///< how a loop of two threads steps its scene, or that it cannot tell how that will move
};

/// One sentence. Of fixed size, so that a servo loop can make one: what is too long is cut off.
struct Notice
{
    Notice() = default;
    /// Copies the sentence, cut off where it is too long.
    Notice(NoticeKind notice_kind, double notice_time, std::string_view sentence);

    NoticeKind kind = NoticeKind::device; ///< what it is about
    double time = 0;                      ///< s; simulated, as RenderedTick::time is
    std::array<char, 240> text{};         ///< ends with 0

    /// The text; valid as long as the notice.
    std::string_view sentence() const { return text.data(); }
};

/// What to do with a notice.
using NoticeSink = std::function<void(const Notice &)>;

/// The limits of a safety stage; all finite and >= 0.
struct SafetyLimits
{
    double max_force = 0;       ///< N
    double max_torque = 0;      ///< N m
    double max_force_rate = 0;  ///< N/s; how fast the force may change
    double max_torque_rate = 0; ///< N m/s
    double max_speed = 0;       ///< m/s; of the hand. Beyond it there is no force
    double ramp_time = 0.5;     ///< s; from nothing to everything, after the start and after each fault
    double engage_force = 0;    ///< N; there is no force before the requested one was once no more than this
    double engage_torque = 0;   ///< N m; likewise

    /// What suits a device:
    /// - the device's own maximum of force; of torque that force at a lever of 5 cm, half a handle (capabilities do not tell it);
    /// - none of what the device has no axes for;
    /// - from zero to the maximum in 5 ms: a tap with 1 m/s on a wall of 1000 N/m stays below that on a PHANToM Desktop;
    /// - the speed of a reach across the whole workspace in 0.3 s, which is as fast as people reach
    ///   (1.875 distance / duration at the peak of a minimum-jerk reach); 2 m/s where the workspace is not known;
    /// - a twentieth of the maximum to engage.
    static SafetyLimits of(const Capabilities &capabilities);
};

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

/// As long as one of these lives, SIGINT, SIGTERM, SIGHUP and SIGQUIT do not end the program but set a flag: the loop then takes the force
/// away and ends in good order. The last one that goes puts back the handlers that the first one found.
///
/// A signal that was ignored before (nohup does that to SIGHUP) stays ignored. Signals that cannot be caught (SIGKILL) or after
/// which nothing can be trusted (SIGSEGV) are left alone: there the device's driver has to notice that the program is gone.
class StopRequest
{
public:
    /// The first one also forgets a request from before. @throws std::system_error when a handler cannot be installed.
    StopRequest();
    ~StopRequest();
    StopRequest(const StopRequest &) = delete;
    StopRequest &operator=(const StopRequest &) = delete;

    /// Whether the program is to end. Any thread; neither locks nor allocates.
    static bool requested() noexcept;

    /// The signal that asked for it; 0 when none did. For a message, or to raise it again after the loop has ended.
    static int signal() noexcept;

    /// The same without a signal; for a window that is closed, say. Any thread, and signal handlers.
    static void request() noexcept;
};
} // namespace ode_predictive_space::haptics

#endif
