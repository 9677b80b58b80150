// A simulated haptic device: a hand that responds to the force, encoders, and delays.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_VIRTUAL_DEVICE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_VIRTUAL_DEVICE_H

#include "ode_predictive_space/haptics/device.h"

#include <functional>
#include <vector>

namespace ode_predictive_space::haptics
{
/// Capabilities of known devices: "PHANToM Desktop", "PHANToM Omni", "Touch", "omega.3" and "Falcon". The numbers are
/// constants of CHAI3D's drivers, not of data sheets. The workspace is the cube around the sphere given there.
const std::vector<Capabilities> &device_presets();

/// The capabilities of a device. @throws std::invalid_argument for an unknown name; the message lists the names.
const Capabilities &device_preset(const std::string &name);

/// A hand that holds the handle: a mass that spring and damper draw to a target x_t, m x'' = F - damping x' +
/// grip_stiffness (x_t - x) + grip_damping (x_t' - x').
struct HandModel
{
    double mass = 0.15;          ///< kg, > 0; of the handle and the moving part of the hand
    double damping = 1;          ///< N s/m, >= 0; of the device itself
    double grip_stiffness = 300; ///< N/m, >= 0
    double grip_damping = 5;     ///< N s/m, >= 0
};

/// Settings of a simulated device and its hand.
struct VirtualDeviceSettings
{
    Capabilities capabilities = device_preset("PHANToM Desktop"); ///< of the device
    HandModel hand;                                               ///< that moves the device
    double encoder_step = 0.00003;                                ///< m, >= 0; quantisation of positions; 0: none
    double velocity_cutoff = 100; ///< Hz, > 0; first-order low-pass filter of velocities
    int position_delay = 0;       ///< ticks, >= 0; of positions; a tick is one read()
    int force_delay = 0;          ///< ticks, >= 0; of forces
};

/// Target position of the hand, m, at a time (s) after the first read().
using TargetPath = std::function<Vector3(double seconds)>;

/// Behaves as sampled hardware: a force is held between writes, and states are quantised, delayed and filtered. So a
/// wall that is too stiff makes it vibrate: with a period T, the hand is stable for about k < b / (T (1/2 + delays)),
/// with the whole damping b of HandModel (2 b / T without delay: Colgate and Schenkel, 1997).
///
/// The hand starts at rest at the target. Between reads it follows the model's exact solution, for a target that is
/// linear in steps of up to 0.2 ms. Forces are limited to capabilities().max_force. The hand does not rotate. Equal
/// calls give equal states.
class VirtualDevice : public SoftwareDevice
{
public:
    /// @throws std::invalid_argument for settings out of range or an empty target.
    VirtualDevice(const VirtualDeviceSettings &settings, TargetPath target);

    void write(const Wrench &wrench) override;

    const Vector3 &true_position() const { return position_; } ///< m; without encoders and delay
    const Vector3 &true_velocity() const { return velocity_; } ///< m/s; likewise
    /// The force on the hand until the next read(), N.
    const Vector3 &rendered_force() const { return rendered_.front(); }

protected:
    void start() override;
    DeviceState move_to(double seconds) override;

private:
    /// Advances position, velocity, driving acceleration and its rate by a step; not aligned, for the reason given at Quaternion.
    using Transition = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;

    void move_hand(double seconds);
    void move_hand_by(const Transition &change, double seconds);
    void measure(double elapsed);
    Vector3 quantised(const Vector3 &position) const;
    Vector3 limited(const Vector3 &force) const;

    VirtualDeviceSettings settings_;
    TargetPath target_;
    double seconds_ = 0;                ///< of the hand
    Vector3 target_position_;           ///< m; at that time
    Vector3 position_;                  ///< m
    Vector3 velocity_;                  ///< m/s
    std::vector<Vector3> rendered_;     ///< N; the force of this tick, then those of the next ones: force_delay + 1
    std::vector<DeviceState> readings_; ///< result of this read(), then of later ones: position_delay + 1
};
} // namespace ode_predictive_space::haptics

#endif
