#include "ode_predictive_space/haptics/safety.h"

#include <algorithm>
#include <cmath>

#include "ode_predictive_space/haptics/device/check_argument.h"
#include "ode_predictive_space/haptics/safety/safety_stage.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double longest_tick = 0.01; // s

double peak_speed_of_reach(const Eigen::AlignedBox3d &workspace)
{
    constexpr double duration = 0.3; // s
    constexpr double unknown = 2;    // m/s
    if (workspace.isEmpty())
        return unknown;
    const double speed = 1.875 * workspace.diagonal().norm() / duration;
    return std::isfinite(speed) && speed > 0 ? speed : unknown;
}

/// The vector, shortened to the allowed length, also after rounding.
Vector3 shortened(const Vector3 &vector, double most)
{
    // Scaled by the largest component, because squares overflow or underflow.
    const double largest = vector.cwiseAbs().maxCoeff();
    if (largest == 0)
        return vector;
    const Vector3 scaled = vector / largest;
    const double length = scaled.norm();
    if (length * largest <= most)
        return vector;
    return scaled * (most / length * (1 - 1e-15));
}

Vector3 stepped(const Vector3 &from, const Vector3 &to, double step)
{
    const Vector3 change = to - from;
    const Vector3 allowed = shortened(change, step);
    return allowed == change ? to : from + allowed;
}

bool is_zero(const Wrench &wrench)
{
    return wrench.force.isZero(0) && wrench.torque.isZero(0);
}
} // namespace

SafetyLimits SafetyLimits::of(const Capabilities &capabilities)
{
    constexpr double lever = 0.05;      // m
    constexpr double rise_time = 0.005; // s
    constexpr double small = 0.05;      // of the maximum

    SafetyLimits limits;
    limits.max_force = capabilities.force_axes >= 3 ? capabilities.max_force : 0;
    limits.max_torque = capabilities.force_axes >= 6 ? capabilities.max_force * lever : 0;
    limits.max_force_rate = limits.max_force / rise_time;
    limits.max_torque_rate = limits.max_torque / rise_time;
    limits.max_speed = peak_speed_of_reach(capabilities.workspace);
    limits.engage_force = small * limits.max_force;
    limits.engage_torque = small * limits.max_torque;
    return limits;
}

const char *explanation_of(SafetyAction action)
{
    static constexpr const char *explanations[] = {
        "No force, as the law or the device gave a number that is not finite.",
        "No force, as the hand moved faster than the limit; the device may be throwing it.",
        "No force yet, as the request was never small: the probe is inside of something, or far from its tool body.",
        "No force, as the device's maximum force is 0 or unknown.",
        "Less force than requested, as it was above the device's maximum."};
    return explanations[static_cast<int>(action)];
}

SafetyStage::SafetyStage(const SafetyLimits &limits) : limits_(limits)
{
    check_not_negative(limits.max_force, "maximum force");
    check_not_negative(limits.max_torque, "maximum torque");
    check_not_negative(limits.max_force_rate, "maximum rate of force");
    check_not_negative(limits.max_torque_rate, "maximum rate of torque");
    check_not_negative(limits.max_speed, "maximum speed of the hand");
    check_not_negative(limits.ramp_time, "ramp time of the force");
    check_not_negative(limits.engage_force, "force to engage");
    check_not_negative(limits.engage_torque, "torque to engage");
}

Wrench SafetyStage::limit(const Wrench &requested, const Vector3 &velocity, double time, double allowance)
{
    const std::uint32_t before = report_.now;
    report_.now = 0;
    const double elapsed = time_since_last_call(time);

    Wrench result;
    if (must_be_zero(requested, velocity, time, allowance))
        ramp_ = 0;
    else if (has_engaged(requested))
    {
        const double allowed = std::clamp(allowance, 0.0, 1.0);
        const Wrench target = scale_down(clamp(requested), elapsed, allowed);
        result = bound(slew(target, elapsed), allowed);
    }

    last_ = result;
    report_.begun = report_.now & ~before;
    return result;
}

double SafetyStage::time_since_last_call(double time)
{
    if (!std::isfinite(time))
        return 0;
    const double elapsed = last_time_ ? std::clamp(time - *last_time_, 0.0, longest_tick) : 0;
    last_time_ = time;
    return elapsed;
}

bool SafetyStage::must_be_zero(const Wrench &requested, const Vector3 &velocity, double time, double allowance)
{
    const bool finite = requested.force.allFinite() && requested.torque.allFinite() && velocity.allFinite() &&
                        std::isfinite(time) && std::isfinite(allowance);
    if (!finite)
        take(SafetyAction::not_finite);
    else if (velocity.norm() > limits_.max_speed)
        take(SafetyAction::too_fast);
    else if (limits_.max_force == 0 && limits_.max_torque == 0 && !is_zero(requested))
        take(SafetyAction::no_axes);
    return report_.now != 0;
}

bool SafetyStage::has_engaged(const Wrench &requested)
{
    if (requested.force.norm() <= limits_.engage_force && requested.torque.norm() <= limits_.engage_torque)
        engaged_ = true;
    if (!engaged_)
        take(SafetyAction::waiting);
    return engaged_;
}

Wrench SafetyStage::clamp(const Wrench &requested)
{
    Wrench result = bound(requested, 1);
    const bool changes_torque = limits_.max_torque > 0 && result.torque != requested.torque;
    if (result.force != requested.force || changes_torque)
        take(SafetyAction::clamped);
    return result;
}

Wrench SafetyStage::scale_down(const Wrench &wrench, double elapsed, double allowed)
{
    ramp_ = limits_.ramp_time > elapsed ? std::min(1.0, ramp_ + elapsed / limits_.ramp_time) : 1;
    if (ramp_ < 1)
        take(SafetyAction::ramping);
    if (allowed < 1)
        take(SafetyAction::held_back);
    return {ramp_ * allowed * wrench.force, ramp_ * allowed * wrench.torque};
}

Wrench SafetyStage::slew(const Wrench &target, double elapsed) const
{
    return {stepped(last_.force, target.force, limits_.max_force_rate * elapsed),
            stepped(last_.torque, target.torque, limits_.max_torque_rate * elapsed)};
}

Wrench SafetyStage::bound(const Wrench &wrench, double allowed) const
{
    return {shortened(wrench.force, allowed * limits_.max_force),
            shortened(wrench.torque, allowed * limits_.max_torque)};
}

void SafetyStage::restart_ramp()
{
    last_ = Wrench();
    ramp_ = 0;
}

void SafetyStage::reset()
{
    restart_ramp();
    last_time_.reset();
    engaged_ = false;
}
} // namespace ode_predictive_space::haptics
