// Safety for programs: notices, limits, stability, and requests to stop.

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
/// Topics of notices.
enum class NoticeKind
{
    device,     ///< a device failed, or answers again
    contact,    ///< a contact is not finite, or a mesh is being read
    safety,     ///< the safety stage takes the force away or clamps it
    watchdog,   ///< servo or scene are late: the force decays
    stability,  ///< a request is too stiff for the device
    guard,      ///< the loop hung, and its guard has set zero force
    exception,  ///< the program's callback threw
    stop,       ///< the loop was asked to end
    scheduling, ///< the system refused priority or locked memory
    coupling    ///< steps and predictions of a loop of two threads
};

/// One sentence, of fixed size so that a servo can make one.
struct Notice
{
    Notice() = default;
    /// Copies the sentence; a long one is cut off.
    Notice(NoticeKind notice_kind, double notice_time, std::string_view sentence);

    NoticeKind kind = NoticeKind::device; ///< topic
    double time = 0;                      ///< s; simulated, as RenderedTick::time
    std::array<char, 240> text{};         ///< zero-terminated

    /// The text; valid during the notice's lifetime.
    std::string_view sentence() const { return text.data(); }
};

/// Receiver of notices.
using NoticeSink = std::function<void(const Notice &)>;

/// The limits of a safety stage; all finite and >= 0.
struct SafetyLimits
{
    double max_force = 0;       ///< N
    double max_torque = 0;      ///< N m
    double max_force_rate = 0;  ///< N/s; rate of change of the force
    double max_torque_rate = 0; ///< N m/s
    double max_speed = 0;       ///< m/s; of the hand, for a force
    double ramp_time = 0.5;     ///< s; from zero to full force, after the start and each fault
    double engage_force = 0;    ///< N; the request has to be at most this once before a force
    double engage_torque = 0;   ///< N m; likewise

    /// Limits for a device:
    /// - the device's maximum of force, and of torque that force at a lever of 5 cm, half a handle;
    /// - zero for absent axes;
    /// - from zero to the maximum in 5 ms, which exceeds a tap with 1 m/s on a wall of 1000 N/m with a PHANToM Desktop;
    /// - the peak speed of a minimum-jerk reach across the workspace in 0.3 s, 1.875 distance / duration, which is as
    ///   fast as people reach; 2 m/s for an unknown workspace;
    /// - a twentieth of the maximum to engage.
    static SafetyLimits of(const Capabilities &capabilities);
};

/// A rendering as the device sees it (with a workspace mapping of scale s, a law's values times s).
struct Rendering
{
    double stiffness = 0;                 ///< N/m; K
    double damping = 0;                   ///< N s/m; B, of the law
    double rate = 1000;                   ///< Hz; of the servo loop, 1 / T
    double delay = 0;                     ///< s; from a position to its force, beyond the loop's period
    std::optional<double> device_damping; ///< N s/m; b, of device and hand, if known
};

/// Result of check_stability().
enum class StabilityOutcome
{
    fine,    ///< as requested
    clamped, ///< with less stiffness or damping
    refused  ///< invalid arguments, or no passive rendering
};

/// The rendering in place of the requested one.
struct StabilityVerdict
{
    StabilityOutcome outcome = StabilityOutcome::fine; ///< difference from the request
    double stiffness = 0;                              ///< N/m; to be used
    double damping = 0;                                ///< N s/m; to be used
    std::string reason;                                ///< one sentence; empty when fine
};

/// Compares a rendering with the device's capabilities.
///
/// A sampled wall of stiffness K and damping B, held from tick to tick, is passive for any motion if and only if
///
///     b > K T / 2 + |B|
///
/// with the device's damping b (Colgate and Schenkel, "Passivity of a class of sampled-data systems", 1997). A further
/// delay D acts as half a period does: b > K (T / 2 + D) + |B|. Hence K is at most 2 (b - |B|) / (T + 2 D), which is 2
/// b / T for a plain spring without delay. Also, K is at most the device's max_stiffness and B at most its max_damping,
/// if known (above 0); the former holds for the nominal rate, and is reduced in proportion in a slower loop.
///
/// Without a known b, the device's limits count, which were found by trial with a damping hand and without delay. A
/// delay reduces K to at most max_stiffness T0 / (T + 2 D), with the device's nominal period T0.
StabilityVerdict check_stability(const Capabilities &capabilities, const Rendering &rendering);

/// During its lifetime, SIGINT, SIGTERM, SIGHUP and SIGQUIT set a flag instead of ending the program: the loop sets
/// zero force and ends. The last instance restores the handlers that the first one found.
///
/// Ignored signals (SIGHUP under nohup) stay ignored. SIGKILL and faults such as SIGSEGV are not handled: the device's
/// driver has to detect the end of the program.
class StopRequest
{
public:
    /// Installs the handlers; the first instance clears the flag. @throws std::system_error when a handler cannot be
    /// installed.
    StopRequest();
    ~StopRequest();
    StopRequest(const StopRequest &) = delete;
    StopRequest &operator=(const StopRequest &) = delete;

    /// Whether a stop was requested. From any thread; neither locks nor allocates.
    static bool requested() noexcept;

    /// The signal that requested the stop, or 0: for a message, or to raise it again after the loop.
    static int signal() noexcept;

    /// Requests a stop without a signal, such as for a closed window. From any thread and signal handlers.
    static void request() noexcept;
};
} // namespace ode_predictive_space::haptics

#endif
