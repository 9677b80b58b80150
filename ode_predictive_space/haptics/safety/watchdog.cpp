#include "ode_predictive_space/haptics/safety/watchdog.h"

#include <algorithm>
#include <utility>

#include "ode_predictive_space/haptics/device/check_argument.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double decay_time = 0.005;   // s from full force to none, <= 0.01
constexpr double recovery_time = 0.25; // s from none to full force after a fault
constexpr int most_missed = 20;        // deadlines in a row
} // namespace

const char *explanation_of(WatchdogReason reason)
{
    static constexpr const char *explanations[] = {
        nullptr, nullptr, "The force is removed, as the scene has not been stepped for too long.",
        "The force is removed, as the servo loop misses its deadlines."};
    return explanations[static_cast<int>(reason)];
}

WatchdogLimits WatchdogLimits::of(double servo_rate, double physics_rate)
{
    constexpr double overdue = 0.003; // s; after the due time of a sign of life
    constexpr double least = 0.004;   // s
    check_positive(servo_rate, "rate of the servo loop");
    check_positive(physics_rate, "rate of the physics");

    WatchdogLimits limits;
    limits.stale_after = std::max(least, 1 / physics_rate + overdue);
    limits.late_after = std::max(least, 1 / servo_rate + overdue);
    limits.late_period = 1.5 / servo_rate;
    return limits;
}

void Watchdog::servo_ticked(double time)
{
    const double elapsed = last_tick_ ? std::max(0.0, time - *last_tick_) : 0;
    const Fault fault = find_fault(time, elapsed);
    reason_before_ = std::exchange(reason_, fault.reason);

    if (last_tick_ && time < *last_tick_) // the elapsed time is unknown
    {
        reason_ = WatchdogReason::servo_late;
        factor_ = 0;
    }
    else if (fault.reason == WatchdogReason::none)
        factor_ = std::min(1.0, factor_ + elapsed / recovery_time);
    else
        factor_ = std::max(0.0, factor_ - std::clamp(fault.lasts, 0.0, elapsed) / decay_time);

    last_tick_ = time;
}

Watchdog::Fault Watchdog::find_fault(double time, double elapsed)
{
    const bool many_missed = missed_too_many(elapsed);
    const double stale_for = time - physics_time_.load(std::memory_order_relaxed) - limits_.stale_after;
    const double late_for = elapsed - limits_.late_after;

    if (!device_answers_)
        return {WatchdogReason::device_lost, elapsed};
    if (!(stale_for <= 0))
        return {WatchdogReason::physics_stale, std::max(stale_for, late_for)};
    if (many_missed)
        return {WatchdogReason::servo_late, elapsed};
    if (!(late_for <= 0))
        return {WatchdogReason::servo_late, late_for};
    return {WatchdogReason::none, 0};
}

bool Watchdog::missed_too_many(double elapsed)
{
    missed_in_a_row_ = elapsed > limits_.late_period ? std::min(missed_in_a_row_ + 1, most_missed) : 0;
    return missed_in_a_row_ == most_missed;
}
} // namespace ode_predictive_space::haptics
