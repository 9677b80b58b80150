// The pointer and the wheel of a window as a device.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_MOUSE_DEVICE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_MOUSE_DEVICE_H

#include "ode_predictive_space/haptics/device.h"

#include <atomic>

namespace ode_predictive_space::haptics
{
/// Mapping of pointer and wheel to the handle.
struct MouseSettings
{
    Eigen::AlignedBox3d workspace{Vector3::Constant(-0.1), Vector3::Constant(0.1)}; ///< m; the handle stays in it
    double metres_per_pixel = 0.0004;                                               ///< > 0
    double metres_per_wheel_step = 0.005;                                           ///< > 0
    double smoothing = 0.015; ///< s, > 0; time constant of each of the two filters
};

/// The window's thread feeds events, the servo's thread reads; neither waits. Events come in jumps, 60 to 125 times a
/// second: two low-pass filters of first order in series make a smooth motion, whose velocity is its derivative and at
/// most (size of the workspace) / smoothing. The handle lags behind the pointer by 2 * smoothing, and starts in the
/// middle of the workspace. It renders no force.
class MouseDevice : public SoftwareDevice
{
public:
    /// @throws std::invalid_argument for settings out of range.
    explicit MouseDevice(const MouseSettings &settings = {});

    /// Moves the handle by `dx` pixels to the right and `dy` down, within the workspace. From any thread.
    void pointer(double dx, double dy) noexcept;

    /// Moves the handle by `steps` of the wheel, away from the person if > 0. From any thread.
    void wheel(double steps) noexcept;

    /// Presses or releases button `number` (0 to 31; others are ignored). From any thread.
    void button(int number, bool down) noexcept;

protected:
    void start() override;
    DeviceState move_to(double seconds) override;

private:
    void shift(int axis, double distance) noexcept;

    MouseSettings settings_;
    std::atomic<double> target_[3]; ///< m; sum of the events
    std::atomic<std::uint32_t> buttons_{0};
    Vector3 between_;  ///< m; after the first filter
    Vector3 position_; ///< m; after the second
    double seconds_ = 0;
};
} // namespace ode_predictive_space::haptics

#endif
