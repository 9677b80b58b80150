// Takes the force away when the program does not keep up.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_WATCHDOG_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_WATCHDOG_H

#include <atomic>

namespace ode_predictive_space::haptics
{
/// Why a watchdog holds the force back; the foremost reason first.
enum class WatchdogReason
{
    none,
    device_lost,   ///< the device does not answer
    physics_stale, ///< the scene has not been stepped for too long
    servo_late     ///< the servo loop missed its deadline by much, or many of them in a row
};

/// Of WatchdogReason.
constexpr int watchdog_reason_count = 4;

/// One sentence for people.
const char *explanation_of(WatchdogReason reason);

/// When a watchdog bites. All finite and > 0, but ramp_time, which may be 0.
struct WatchdogLimits
{
    double stale_after = 0.004;  ///< s without a step of the scene
    double late_after = 0.004;   ///< s between two ticks of the servo loop
    double late_period = 0.0015; ///< s between two ticks; more is a missed deadline
    int late_in_a_row = 20;      ///< that many missed deadlines one after the other are too many
    double decay_time = 0.005;   ///< s from full force to none, <= 0.01
    double ramp_time = 0.25;     ///< s from none to full force, when all is well again

    /// What suits two rates in Hz: a sign of life is overdue 3 ms after it should have come, but not less than 4 ms after the one
    /// before. Whether a scene hangs, or only uses the time that it has, cannot be told before its step is due.
    static WatchdogLimits of(double servo_rate, double physics_rate);
};

/// Watches the servo loop, the physics and the device, and gives the part of the force that is still allowed.
///
/// It falls to 0 within decay_time from the moment of a fault (as a straight line: a deadline missed by little costs little) and
/// comes back within ramp_time. It begins at 0, and rises when everything has shown that it lives.
///
/// physics_fresh() may be called from any thread; all else belongs to the servo loop. Neither allocates nor locks. Times are in seconds
/// on one clock. Of a servo loop that hangs, the loop's guard takes care.
class Watchdog
{
public:
    /// @throws std::invalid_argument when a limit is out of its range.
    explicit Watchdog(const WatchdogLimits &limits = {});

    /// The scene was stepped, or its state found to be as of this time.
    void physics_fresh(double time) { physics_time_.store(time, std::memory_order_relaxed); }

    /// Whether the device answered in this tick. It counts as lost before the first call.
    void device_answered(bool answered) { device_answers_ = answered; }

    /// One tick of the servo loop; after the two above. Then factor() and reason() are up to date.
    void servo_ticked(double time);

    /// 0 to 1; what the force is to be multiplied by.
    double factor() const { return factor_; }

    /// Why factor() falls or stays at 0; none while it rises.
    WatchdogReason reason() const { return reason_; }

    /// Whether it was another one in the tick before.
    bool has_new_reason() const { return reason_ != reason_before_; }

private:
    struct Fault
    {
        WatchdogReason reason;
        double lasts; // s, up to this tick; may be more than since the last one
    };

    Fault find_fault(double time, double elapsed);
    bool missed_too_many(double elapsed);

    static_assert(std::atomic<double>::is_always_lock_free, "nothing may lock in a servo loop");

    WatchdogLimits limits_;
    std::atomic<double> physics_time_;
    bool device_answers_ = false;
    double last_tick_ = 0;
    bool has_ticked_ = false;
    int missed_in_a_row_ = 0;
    double factor_ = 0;
    WatchdogReason reason_ = WatchdogReason::device_lost;
    WatchdogReason reason_before_ = WatchdogReason::none;
};
} // namespace ode_predictive_space::haptics

#endif
