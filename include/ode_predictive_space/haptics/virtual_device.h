// A haptic device without hardware: a hand that feels the force, encoders that count, and delays.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_VIRTUAL_DEVICE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_VIRTUAL_DEVICE_H

#include "ode_predictive_space/haptics/device.h"

#include <functional>
#include <vector>

namespace ode_predictive_space::haptics
{
/// What known devices can do: "PHANToM Desktop", "PHANToM Omni", "Touch", "omega.3" and "Falcon". The numbers are the
/// constants of CHAI3D's drivers, not those of data sheets. The workspace is the cube around the sphere given there.
const std::vector<Capabilities> &device_presets();

/// One of them. @throws std::invalid_argument for another name; the message lists these.
const Capabilities &device_preset(const std::string &name);

/// A hand that holds the handle: one mass, drawn by a spring and a damper towards where the person wants it to be,
/// m x'' = F - damping x' + grip_stiffness (x_t - x) + grip_damping (x_t' - x').
struct HandModel
{
    double mass = 0.15;          ///< kg, > 0; of the handle and of what of the hand moves with it
    double damping = 1;          ///< N s/m, >= 0; of the device itself
    double grip_stiffness = 300; ///< N/m, >= 0
    double grip_damping = 5;     ///< N s/m, >= 0
};

/// What device is simulated, and what hand holds it.
struct VirtualDeviceSettings
{
    Capabilities capabilities = device_preset("PHANToM Desktop"); ///< of the device
    HandModel hand;                                               ///< feels the force
    double encoder_step = 0.00003; ///< m, >= 0; positions are told in whole steps; 0: exactly
    double velocity_cutoff = 100;  ///< Hz, > 0; of the low-pass filter of first order over the differences of positions
    int position_delay = 0;        ///< ticks, >= 0; how late a position is told; a tick is one read()
    int force_delay = 0;           ///< ticks, >= 0; how late a force is rendered
};

/// Where the person wants the handle to be, in metres, this many seconds after the first read().
using TargetPath = std::function<Vector3(double seconds)>;

/// It behaves as sampled hardware does: a force stays from one write() to the next, and what read() tells is quantised,
/// delayed and filtered. So a wall that is too stiff makes it vibrate, as it would the real thing: with the spring sampled
/// every T seconds the hand stands still only for k < b / (T (1/2 + delays)), about, where b is all damping of HandModel
/// (2 b / T: Colgate and Schenkel, 1997, for no delay).
///
/// The hand starts at rest at the target. Between reads it moves as the model's exact solution, with the target taken as
/// straight for up to 0.2 ms. The motors render no more than capabilities().max_force. The hand does not turn. The same
/// calls give the same states.
class VirtualDevice : public SoftwareDevice
{
public:
    /// @throws std::invalid_argument for settings out of range or without a target.
    VirtualDevice(const VirtualDeviceSettings &settings, TargetPath target);

    void write(const Wrench &wrench) override;

    const Vector3 &true_position() const { return position_; } ///< m; what encoders and delay hide
    const Vector3 &true_velocity() const { return velocity_; } ///< m/s; the same
    /// N; what the hand feels until the next read().
    const Vector3 &rendered_force() const { return rendered_.front(); }

protected:
    void start() override;
    DeviceState move_to(double seconds) override;

private:
    /// Of the hand over one step; not aligned, for the reason given at Quaternion.
    using Transition = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;

    void move_hand(double seconds);
    void move_hand_by(const Transition &change, double seconds);
    void measure(double elapsed);
    Vector3 quantised(const Vector3 &position) const;
    Vector3 limited(const Vector3 &force) const;

    VirtualDeviceSettings settings_;
    TargetPath target_;
    double seconds_ = 0;                ///< up to which the hand has moved
    Vector3 target_position_;           ///< m; at that time
    Vector3 position_;                  ///< m
    Vector3 velocity_;                  ///< m/s
    std::vector<Vector3> rendered_;     ///< N; the force of this tick, then those of the next ones: force_delay + 1
    std::vector<DeviceState> readings_; ///< what this read() returns, then what later ones do: position_delay + 1
};
} // namespace ode_predictive_space::haptics

#endif
