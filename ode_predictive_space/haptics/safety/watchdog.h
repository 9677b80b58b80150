// The watchdog, which reduces the force when the program does not keep up.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_WATCHDOG_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_WATCHDOG_H

#include <atomic>
#include <limits>
#include <optional>

namespace ode_predictive_space::haptics
{
/// Reasons of the watchdog; of several, the first counts.
enum class WatchdogReason
{
    none,
    device_lost,   ///< the device does not answer
    physics_stale, ///< the scene has not been stepped for too long
    servo_late     ///< the servo missed a deadline by much, or many in a row
};

/// 0 for no reason, and for a lost device, which DeviceLink reports.
const char *explanation_of(WatchdogReason reason);

/// Limits of a watchdog. All finite and > 0.
struct WatchdogLimits
{
    double stale_after = 0.004;  ///< s without a step of the scene
    double late_after = 0.004;   ///< s between two ticks of the servo loop
    double late_period = 0.0015; ///< s between two ticks; more is a missed deadline

    /// Limits for two rates in Hz: a sign of life is overdue 3 ms after its due time, but at least 4 ms after the
    /// former one. A hang cannot be recognised before the step is due.
    static WatchdogLimits of(double servo_rate, double physics_rate);
};

/// The allowed part of the force falls linearly to 0 within 5 ms of a fault, so that a slightly late tick costs little, and
/// rises within 0.25 s. It begins at 0, and rises after signs of life of servo, physics and device. physics_fresh() may be
/// called from any thread, all else from the servo. Neither allocates nor locks. Times are in s on one clock. LoopGuard handles
/// a servo that hangs.
class Watchdog
{
public:
    explicit Watchdog(const WatchdogLimits &limits = {}) : limits_(limits) {}

    void physics_fresh(double time) { physics_time_.store(time, std::memory_order_relaxed); }

    /// Whether the device answered in this tick; it counts as lost before the first call.
    void device_answered(bool answered) { device_answers_ = answered; }

    /// Updates factor() and reason() in a tick, after the two above.
    void servo_ticked(double time);

    double factor() const { return factor_; }

    /// The reason for which factor() falls or stays at 0; none while it rises.
    WatchdogReason reason() const { return reason_; }

    bool has_new_reason() const { return reason_ != reason_before_; }

private:
    struct Fault
    {
        WatchdogReason reason;
        double lasts; // s, up to this tick; may exceed the time since the last tick
    };

    Fault find_fault(double time, double elapsed);
    bool missed_too_many(double elapsed);

    static_assert(std::atomic<double>::is_always_lock_free, "nothing may lock in a servo loop");

    WatchdogLimits limits_;
    std::atomic<double> physics_time_{-std::numeric_limits<double>::infinity()};
    bool device_answers_ = false;
    std::optional<double> last_tick_;
    int missed_in_a_row_ = 0;
    double factor_ = 0;
    WatchdogReason reason_ = WatchdogReason::device_lost;
    WatchdogReason reason_before_ = WatchdogReason::none;
};
} // namespace ode_predictive_space::haptics

#endif
