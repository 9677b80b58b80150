// Sees to it that what is rendered gives no energy to the hand.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PASSIVITY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PASSIVITY_H

#include "ode_predictive_space/haptics/device.h"
#include "ode_predictive_space/haptics/device/check_argument.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ode_predictive_space::haptics
{
/// Passivity observer and passivity controller (Hannaford and Ryu, "Time-domain passivity control of haptic interfaces", 2002),
/// for an impedance device, linear axes.
///
/// The observer adds up the energy that went from the hand into what is rendered: minus the force that was written, times how
/// far the hand has moved under it. As a device holds its force from write to write, that is no estimate. While
/// it is negative, energy was created out of nothing, as by a wall that is too stiff or late, and the controller adds damping so
/// that one tick takes the surplus out again, or as much of it as max_damping permits.
///
/// Where device and driver are late (see set_delay()), the observer compares each motion with the force under which it came about. The
/// damping is late, too; so a delay has to make walls softer first (see check_stability()).
///
/// While no force is requested, nothing is stored that could be given back: then a credit ends, so that it cannot hide later
/// activity; a debt stays.
class PassivityController
{
public:
    /// @param max_damping N s/m, finite, >= 0; of the controller. Capabilities::max_damping suits; 0 makes it an observer.
    /// @throws std::invalid_argument
    explicit PassivityController(double max_damping) : max_damping_(max_damping)
    {
        check_not_negative(max_damping, "damping of a passivity controller");
        written_.fill(Vector3::Zero());
    }

    /// Sets the round-trip delay: a position that is read now is the result of the force that was written so many ticks ago.
    ///
    /// @param ticks up to most_delay.
    void set_delay(int ticks) { delay_ = static_cast<std::size_t>(std::clamp(ticks, 0, most_delay)); }

    static constexpr int most_delay = 63; ///< ticks

    /// One tick, before the safety stage.
    ///
    /// @param requested N; the law's force on the hand.
    /// @param dt seconds from this tick to the next, > 0.
    /// @return the requested force plus the controller's damping. All in the device's frame.
    Vector3 control(const DeviceState &state, const Vector3 &requested, double dt)
    {
        if (has_position_)
            energy_ -=
                written_[(newest_ + written_.size() - delay_) % written_.size()].dot(state.position - last_position_);
        if (!std::isfinite(energy_))
            energy_ = 0; // a fault that others look for; it must not stay here
        last_position_ = state.position;
        has_position_ = true;
        if (energy_ > 0 && requested.isZero(0))
            energy_ = 0;

        // The damping that takes out in the coming tick, if the hand goes on as it does, what was created so far.
        damping_ = 0;
        const double squared_speed = state.linear_velocity.squaredNorm();
        if (energy_ < 0 && squared_speed > 0)
            damping_ = std::min(max_damping_, -energy_ / (squared_speed * dt));

        newest_ = (newest_ + 1) % written_.size();
        written_[newest_] = requested - damping_ * state.linear_velocity;
        return written_[newest_];
    }

    /// What was really written after control(), where that differs.
    void written(const Vector3 &force) { written_[newest_] = force; }

    double energy() const { return energy_; }   ///< J; into what is rendered, up to the last control()
    double damping() const { return damping_; } ///< N s/m; what the controller added in the last control()

    /// As at the start: no energy.
    void reset()
    {
        energy_ = 0;
        damping_ = 0;
        written_.fill(Vector3::Zero());
        has_position_ = false;
    }

private:
    double max_damping_;
    double energy_ = 0;
    double damping_ = 0;
    std::array<Vector3, most_delay + 1> written_; ///< N; a ring
    std::size_t newest_ = 0;
    std::size_t delay_ = 0; ///< ticks
    Vector3 last_position_ = Vector3::Zero();
    bool has_position_ = false;
};
} // namespace ode_predictive_space::haptics

#endif
