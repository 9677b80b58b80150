// Messages of the haptics library to the user.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NOTICE_H

#include <array>
#include <functional>
#include <string_view>

namespace ode_predictive_space::haptics
{
/// What a notice is about.
enum class NoticeKind
{
    device,     ///< a device failed, or is back
    contact,    ///< a contact is not a number
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
} // namespace ode_predictive_space::haptics

#endif
