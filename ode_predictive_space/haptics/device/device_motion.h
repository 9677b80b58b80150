// What a device's positions say of its motion.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_MOTION_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_MOTION_H

#include "ode_predictive_space/haptics/device.h"

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
    void follow(DeviceState &state);

    /// m/s; between the last two positions. 0 after the first.
    double speed() const { return speed_; }

    /// What comes next has nothing to do with what was.
    void forget();

private:
    void estimate(const DeviceState &state);

    double period_; ///< s
    bool has_last_ = false;
    bool tells_velocity_ = false;
    double speed_ = 0;
    DeviceState last_;
    DeviceState measured_; ///< at least a period before: from there on, the velocity is measured
    Vector3 velocity_ = Vector3::Zero();
};
} // namespace ode_predictive_space::haptics

#endif
