// What the states of a device say of its motion and its delay.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_MOTION_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_MOTION_H

#include "ode_predictive_space/haptics/device.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ode_predictive_space::haptics
{
/// Follows a device from state to state: a device that has never told a velocity but zero gets one from its positions, and how fast the
/// positions change is known whatever the device tells. Angular velocities are left as they are. Neither allocates nor locks.
class DeviceMotion
{
public:
    /// @param rate Hz, > 0; of the device: how often it can have a new position.
    explicit DeviceMotion(double rate) : period_(1 / rate) {}

    /// The next state; its velocity is filled in where the device tells none (smoothed over some 2 ms).
    void follow(DeviceState &state)
    {
        tells_velocity_ = tells_velocity_ || !state.linear_velocity.isZero(0);
        if (!last_)
            last_ = measured_ = state;
        // A device cannot have moved for less than its period, whatever two reads say of their times.
        speed_ = (state.position - last_->position).norm() / std::max(period_, state.time - last_->time);
        last_ = state;
        const double elapsed = state.time - measured_.time;
        if (elapsed >= whole_period * period_)
        {
            const Vector3 mean = (state.position - measured_.position) / elapsed;
            velocity_ += (1 - std::exp(-elapsed / smoothing)) * (mean - velocity_);
            measured_ = state;
        }
        if (!tells_velocity_)
            state.linear_velocity = velocity_;
    }

    /// m/s; between the last two positions. 0 after the first.
    double speed() const { return speed_; }

    /// What comes next has nothing to do with what was.
    void forget()
    {
        last_.reset();
        speed_ = 0;
        velocity_.setZero();
    }

private:
    static constexpr double smoothing = 0.002;   ///< s
    static constexpr double whole_period = 0.99; ///< of one: times are rounded

    double period_; ///< s
    bool tells_velocity_ = false;
    double speed_ = 0;
    std::optional<DeviceState> last_;
    DeviceState measured_; ///< at least a period before: from there on, the velocity is measured
    Vector3 velocity_ = Vector3::Zero();
};

} // namespace ode_predictive_space::haptics

#endif
