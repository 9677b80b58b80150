#include "ode_predictive_space/haptics/mouse_device.h"

#include "ode_predictive_space/haptics/device/check_argument.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
MouseDevice::MouseDevice(const MouseSettings &settings)
    : SoftwareDevice("mouse", 3, settings.workspace), settings_(settings)
{
    check_positive(settings.metres_per_pixel, "mouse: metres per pixel");
    check_positive(settings.metres_per_wheel_step, "mouse: metres per wheel step");
    check_positive(settings.smoothing, "mouse: the time constant of smoothing");
    for (int axis = 0; axis < 3; ++axis)
        check_positive(settings.workspace.sizes()[axis], "mouse: the size of the workspace");
    MouseDevice::start();
}

void MouseDevice::pointer(double dx, double dy) noexcept
{
    shift(0, dx * settings_.metres_per_pixel);
    shift(1, -dy * settings_.metres_per_pixel);
}

void MouseDevice::wheel(double steps) noexcept
{
    shift(2, -steps * settings_.metres_per_wheel_step);
}

void MouseDevice::button(int number, bool down) noexcept
{
    if (number < 0 || number > 31)
        return;
    const std::uint32_t bit = std::uint32_t{1} << number;
    if (down)
        buttons_.fetch_or(bit);
    else
        buttons_.fetch_and(~bit);
}

void MouseDevice::start()
{
    const Vector3 centre = settings_.workspace.center();
    for (int axis = 0; axis < 3; ++axis)
        target_[axis] = centre[axis];
    buttons_ = 0;
    between_ = position_ = centre;
    seconds_ = 0;
}

// Each filter follows x' = (input - x) / tau. For a constant input the exact solutions stay between the former values
// and the target, whatever the time until the next read().
DeviceState MouseDevice::move_to(double seconds)
{
    const double elapsed = (seconds - seconds_) / settings_.smoothing;
    seconds_ = seconds;
    const double left = std::exp(-elapsed);
    const Vector3 target(target_[0], target_[1], target_[2]);
    const Vector3 distance = between_ - target;
    position_ = target + left * (position_ - target + elapsed * distance);
    between_ = target + left * distance;

    DeviceState state;
    state.position = position_;
    state.linear_velocity = (between_ - position_) / settings_.smoothing;
    state.buttons = buttons_;
    return state;
}

void MouseDevice::shift(int axis, double distance) noexcept
{
    if (!std::isfinite(distance))
        return;
    std::atomic<double> &target = target_[axis];
    const double low = settings_.workspace.min()[axis];
    const double high = settings_.workspace.max()[axis];
    double old = target;
    while (!target.compare_exchange_weak(old, std::clamp(old + distance, low, high)))
    {}
}
} // namespace ode_predictive_space::haptics
