// What limits the force: the last stage before a device, and what can be rendered stably.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SAFETY_STAGE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SAFETY_STAGE_H

#include "ode_predictive_space/haptics/safety.h"

namespace ode_predictive_space::haptics
{
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

    /// As at the start: the next wrench is zero, and the stage waits for a small one. Counts go on.
    void reset();

    /// The force was taken away behind the stage, and nothing else has changed: the next wrench is zero, and it comes back by the ramp.
    void restart_ramp();

    /// Whether the requested wrench was small once since the start.
    bool engaged() const { return engaged_; }

    /// What was done in the last call and so far.
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
