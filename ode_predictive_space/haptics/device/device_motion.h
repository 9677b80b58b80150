// Motion of a device from its states.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_MOTION_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_MOTION_H

#include "ode_predictive_space/haptics/device.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ode_predictive_space::haptics
{
/// Neither allocates nor locks. Angular velocities are unchanged.
class DeviceMotion
{
public:
    explicit DeviceMotion(double rate) : period_(1 / rate) {}

    /// Takes the next state, and fills in its velocity (smoothed over some 2 ms) if the device reports none.
    void follow(DeviceState &state)
    {
        reports_velocity_ = reports_velocity_ || !state.linear_velocity.isZero(0);
        if (!last_)
            last_ = measured_ = state;
        // A device moves for at least its period, whatever the times of two reads.
        speed_ = (state.position - last_->position).norm() / std::max(period_, state.time - last_->time);
        last_ = state;
        const double elapsed = state.time - measured_.time;
        if (elapsed >= whole_period * period_)
        {
            const Vector3 mean = (state.position - measured_.position) / elapsed;
            velocity_ += (1 - std::exp(-elapsed / smoothing)) * (mean - velocity_);
            measured_ = state;
        }
        if (!reports_velocity_)
            state.linear_velocity = velocity_;
    }

    /// m/s; between the last two positions, 0 after the first.
    double speed() const { return speed_; }

    void forget()
    {
        last_.reset();
        speed_ = 0;
        velocity_.setZero();
    }

private:
    static constexpr double smoothing = 0.002;   ///< s
    static constexpr double whole_period = 0.99; ///< tolerance for rounded times

    double period_; ///< s
    bool reports_velocity_ = false;
    double speed_ = 0;
    std::optional<DeviceState> last_;
    DeviceState measured_; ///< beginning of the present measurement
    Vector3 velocity_ = Vector3::Zero();
};

} // namespace ode_predictive_space::haptics

#endif
