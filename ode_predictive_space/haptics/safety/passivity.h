// Passivity observer and controller for an impedance device, linear axes (Hannaford and Ryu, "Time-domain passivity control of
// haptic interfaces", 2002).

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PASSIVITY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PASSIVITY_H

#include "ode_predictive_space/haptics/device.h"
#include "ode_predictive_space/haptics/device/check_argument.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace ode_predictive_space::haptics
{
/// The observer sums the energy from the hand: minus the written force times the hand's displacement under it, which is exact
/// because a device holds its force between writes. A negative sum means that energy was created, as by a wall that is too
/// stiff or late. Then the controller adds damping that removes the surplus in one tick, up to max_damping. Without a requested
/// force no energy is stored, so a credit ends and cannot hide later activity; a debt remains.
///
/// With a delay (see set_delay()), the observer pairs each motion with the force that caused it. The damping is late, too, so a
/// delay also requires softer walls (see check_stability()).
class PassivityController
{
public:
    /// @param max_damping N s/m, finite, >= 0; usually Capabilities::max_damping; 0 makes it an observer.
    explicit PassivityController(double max_damping) : max_damping_(max_damping)
    {
        check_not_negative(max_damping, "damping of a passivity controller");
        written_.fill(Vector3::Zero());
    }

    /// Sets the round-trip delay from a written force to the position that it causes. @param ticks rounded; up to most_delay.
    void set_delay(double ticks)
    {
        delay_ = static_cast<std::size_t>(std::lround(std::clamp<double>(ticks, 0, most_delay)));
    }

    static constexpr int most_delay = 63; ///< ticks

    /// One tick, before the safety stage, in the device's frame. @param requested N; the law's force on the hand.
    /// @param dt seconds from this tick to the next, > 0. @return the requested force plus the controller's damping.
    Vector3 control(const DeviceState &state, const Vector3 &requested, double dt)
    {
        if (last_position_)
            energy_ -=
                written_[(newest_ + written_.size() - delay_) % written_.size()].dot(state.position - *last_position_);
        if (!std::isfinite(energy_))
            energy_ = 0; // other stages report it
        last_position_ = state.position;
        if (energy_ > 0 && requested.isZero(0))
            energy_ = 0;

        // The damping that removes the surplus in the coming tick at the present velocity.
        damping_ = 0;
        const double squared_speed = state.linear_velocity.squaredNorm();
        if (energy_ < 0 && squared_speed > 0)
            damping_ = std::min(max_damping_, -energy_ / (squared_speed * dt));

        newest_ = (newest_ + 1) % written_.size();
        written_[newest_] = requested - damping_ * state.linear_velocity;
        return written_[newest_];
    }

    /// Sets the written force after control(), where it differs.
    void written(const Vector3 &force) { written_[newest_] = force; }

    double energy() const { return energy_; }   ///< J; from the hand, up to the last control()
    double damping() const { return damping_; } ///< N s/m; of the last control()

    void reset()
    {
        energy_ = 0;
        damping_ = 0;
        written_.fill(Vector3::Zero());
        last_position_.reset();
    }

private:
    double max_damping_;
    double energy_ = 0;
    double damping_ = 0;
    std::array<Vector3, most_delay + 1> written_; ///< N; a ring
    std::size_t newest_ = 0;
    std::size_t delay_ = 0; ///< ticks
    std::optional<Vector3> last_position_;
};
} // namespace ode_predictive_space::haptics

#endif
