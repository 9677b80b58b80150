// What limits the force: the last stage before a device, and what can be rendered stably.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SAFETY_STAGE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SAFETY_STAGE_H

#include "ode_predictive_space/haptics/safety.h"

namespace ode_predictive_space::haptics
{
/// What the safety stage can do to a wrench.
enum class SafetyAction
{
    not_finite,   ///< the wrench, the velocity, the time or the allowance is NaN or infinite: zero, at once
    too_fast,     ///< the hand is faster than max_speed: zero, at once
    waiting,      ///< has not been small since the start: zero
    no_axes,      ///< the device cannot push, or its maximum of force is not told: zero
    ramping,      ///< after the start or a fault: scaled down
    clamped,      ///< was above the maximum: shortened, its direction kept
    slew_limited, ///< would have changed too fast: on its way
    held_back     ///< the allowance was below 1: scaled down
};

/// Of SafetyAction.
constexpr int safety_action_count = 8;

/// One sentence: what the stage does and why.
const char *explanation_of(SafetyAction action);

/// What the safety stage did in its last call.
struct SafetyReport
{
    std::uint32_t now = 0;   ///< bit i: action i was taken
    std::uint32_t begun = 0; ///< those of them that were not taken in the call before

    bool did(SafetyAction action) const { return (now >> static_cast<int>(action)) & 1u; }
    bool began(SafetyAction action) const { return (begun >> static_cast<int>(action)) & 1u; }
};

/// Makes any wrench safe. One stage belongs to one device and is used from its servo loop. Neither allocates nor locks.
///
/// Whatever the requested wrench, the one that is returned
/// - is finite;
/// - is never above the maximum, nor above the maximum times the allowance;
/// - differs from the one before by at most max_force_rate times the time between the calls, except on its way to zero:
///   a fault (not_finite, too_fast) takes the force away at once, since what drives the hand then cannot be trusted, and a
///   falling allowance as fast as it falls. A force never comes at once;
/// - is zero from the start until the requested wrench was small once: a program that starts with the probe inside of something
///   does not kick.
///
/// Time between two calls counts as 10 ms at most: after a pause, the force changes on slowly from where it was.
class SafetyStage
{
public:
    /// @throws std::invalid_argument when a limit is negative or not finite.
    explicit SafetyStage(const SafetyLimits &limits);

    /// One tick of the servo loop.
    ///
    /// @param requested in the device's frame.
    /// @param velocity m/s; of the hand, in the device's frame.
    /// @param time seconds on the loop's clock; going back counts as no time.
    /// @param allowance 0 to 1: which part of the force may be there (see Watchdog).
    /// @return what may be written to the device. Write this and nothing else.
    Wrench limit(const Wrench &requested, const Vector3 &velocity, double time, double allowance = 1);

    /// As at the start: the next wrench is zero, and the stage waits for a small one.
    void reset();

    /// The force was taken away behind the stage, and nothing else has changed: the next wrench is zero, and it comes back by the ramp.
    void restart_ramp();

    /// Whether the requested wrench was small once since the start.
    bool engaged() const { return engaged_; }

    const SafetyReport &report() const { return report_; }
    /// As they were given.
    const SafetyLimits &limits() const { return limits_; }

private:
    double time_since_last_call(double time);
    bool must_be_zero(const Wrench &requested, const Vector3 &velocity, double time, double allowance);
    bool has_engaged(const Wrench &requested);
    Wrench clamp(const Wrench &requested);
    Wrench scale_down(const Wrench &wrench, double elapsed, double allowed);
    Wrench slew(const Wrench &target, double elapsed);
    Wrench bound(const Wrench &wrench, double allowed) const;
    void take(SafetyAction action) { report_.now |= 1u << static_cast<int>(action); }
    void close_report(std::uint32_t before);

    SafetyLimits limits_;
    SafetyReport report_;
    Wrench last_;
    double last_time_ = 0;
    double ramp_ = 0; // 0 to 1
    bool has_time_ = false;
    bool engaged_ = false;
};

/// As check_stability() without words, for where something has to be rendered: neither allocates nor throws. Damping that nothing would make passive
/// becomes none.
///
/// @return what may be rendered; its stiffness and damping are those asked for, or less.
Rendering renderable(const Capabilities &capabilities, const Rendering &rendering) noexcept;
} // namespace ode_predictive_space::haptics

#endif
