#include "ode_predictive_space/haptics/device/device_motion.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double smoothing = 0.002;   // s
constexpr double whole_period = 0.99; // of one: times are rounded
} // namespace

void DeviceMotion::follow(DeviceState &state)
{
    tells_velocity_ = tells_velocity_ || !state.linear_velocity.isZero(0);
    if (!has_last_)
    {
        measured_ = state;
        last_ = state;
        has_last_ = true;
    }
    // A device cannot have moved for less than its period, whatever two reads say of their times.
    speed_ = (state.position - last_.position).norm() / std::max(period_, state.time - last_.time);
    last_ = state;
    estimate(state);
    if (!tells_velocity_)
        state.linear_velocity = velocity_;
}

void DeviceMotion::estimate(const DeviceState &state)
{
    const double elapsed = state.time - measured_.time;
    if (elapsed >= whole_period * period_)
    {
        const Vector3 mean = (state.position - measured_.position) / elapsed;
        velocity_ += (1 - std::exp(-elapsed / smoothing)) * (mean - velocity_);
        measured_ = state;
    }
}

void DeviceMotion::forget()
{
    has_last_ = false;
    speed_ = 0;
    velocity_.setZero();
}
} // namespace ode_predictive_space::haptics
