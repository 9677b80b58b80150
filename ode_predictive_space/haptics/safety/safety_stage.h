// The last stage before a device: limits of the force and of stable stiffness.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SAFETY_STAGE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SAFETY_STAGE_H

#include "ode_predictive_space/haptics/safety.h"

namespace ode_predictive_space::haptics
{
enum class SafetyAction
{
    not_finite, ///< the wrench, the velocity, the time or the allowance is NaN or infinite: zero, at once
    too_fast,   ///< the hand is faster than max_speed: zero, at once
    waiting,    ///< the request was not small since the start: zero
    no_axes,    ///< the device cannot push, or its maximum is unknown: zero
    clamped,    ///< was above the maximum: shortened, its direction kept
    ramping,    ///< after the start or a fault: scaled down
    held_back   ///< the allowance was below 1: scaled down
};

/// The actions that are worth a notice, in the enumeration's order.
constexpr SafetyAction explained_actions[] = {SafetyAction::not_finite, SafetyAction::too_fast, SafetyAction::waiting,
                                              SafetyAction::no_axes, SafetyAction::clamped};

/// For explained_actions only.
const char *explanation_of(SafetyAction action);

struct SafetyReport
{
    std::uint32_t now = 0;   ///< bit i: action i
    std::uint32_t begun = 0; ///< actions that the call before did not take

    bool did(SafetyAction action) const { return (now >> static_cast<int>(action)) & 1u; }
    bool began(SafetyAction action) const { return (begun >> static_cast<int>(action)) & 1u; }
};

/// Limits any wrench to a safe one. One stage belongs to one device and its servo. Neither allocates nor locks. For any
/// request, the returned wrench
/// - is finite, and never above the maximum, nor above the maximum times the allowance;
/// - changes by at most max_force_rate times the time between the calls, except towards zero: a fault (not_finite, too_fast)
///   removes the force at once, and a falling allowance as fast as it falls;
/// - is zero from the start until the request was small once, so that a probe that begins inside of something does not kick.
/// The time between two calls counts as at most 10 ms, so that the force changes slowly after a pause.
class SafetyStage
{
public:
    explicit SafetyStage(const SafetyLimits &limits);

    /// @param requested in the device's frame. @param velocity m/s; of the hand, in the device's frame.
    /// @param time s, on the loop's clock; a step back counts as no time.
    /// @param allowance 0 to 1; allowed part of the force (see Watchdog).
    Wrench limit(const Wrench &requested, const Vector3 &velocity, double time, double allowance = 1);

    /// Returns to the start: zero until the request was small once.
    void reset();

    /// Restarts the ramp from zero, after another part has taken the force away.
    void restart_ramp();

    bool engaged() const { return engaged_; }

    const SafetyReport &report() const { return report_; }
    const SafetyLimits &limits() const { return limits_; }

private:
    double time_since_last_call(double time);
    bool must_be_zero(const Wrench &requested, const Vector3 &velocity, double time, double allowance);
    bool has_engaged(const Wrench &requested);
    Wrench clamp(const Wrench &requested);
    Wrench scale_down(const Wrench &wrench, double elapsed, double allowed);
    Wrench slew(const Wrench &target, double elapsed) const;
    Wrench bound(const Wrench &wrench, double allowed) const;
    void take(SafetyAction action) { report_.now |= 1u << static_cast<int>(action); }

    SafetyLimits limits_;
    SafetyReport report_;
    Wrench last_;
    std::optional<double> last_time_;
    double ramp_ = 0; // 0 to 1
    bool engaged_ = false;
};

/// check_stability() without a text, which neither allocates nor throws. Damping that cannot be passive becomes zero.
/// @return the rendering with allowed stiffness and damping.
Rendering renderable(const Capabilities &capabilities, const Rendering &rendering) noexcept;
} // namespace ode_predictive_space::haptics

#endif
