#include "ode_predictive_space/haptics/safety/passivity.h"

#include <algorithm>

#include "ode_predictive_space/haptics/device/check_argument.h"

namespace ode_predictive_space::haptics
{
PassivityController::PassivityController(double max_damping) : max_damping_(max_damping)
{
    check_not_negative(max_damping, "damping of a passivity controller");
    written_.fill(Vector3::Zero());
}

void PassivityController::set_delay(int ticks)
{
    delay_ = static_cast<std::size_t>(std::clamp(ticks, 0, most_delay));
}

Vector3 PassivityController::control(const DeviceState &state, const Vector3 &wished, double dt)
{
    if (has_position_)
        energy_ -=
            written_[(newest_ + written_.size() - delay_) % written_.size()].dot(state.position - last_position_);
    if (!std::isfinite(energy_))
        energy_ = 0; // a fault that others look for; it must not stay here
    last_position_ = state.position;
    has_position_ = true;
    if (energy_ > 0 && wished.isZero(0))
        energy_ = 0;

    // The damping that takes out in the coming tick, if the hand goes on as it does, what was created so far.
    damping_ = 0;
    const double squared_speed = state.linear_velocity.squaredNorm();
    if (energy_ < 0 && squared_speed > 0)
        damping_ = std::min(max_damping_, -energy_ / (squared_speed * dt));

    newest_ = (newest_ + 1) % written_.size();
    written_[newest_] = wished - damping_ * state.linear_velocity;
    return written_[newest_];
}

void PassivityController::reset()
{
    energy_ = 0;
    damping_ = 0;
    written_.fill(Vector3::Zero());
    has_position_ = false;
}
} // namespace ode_predictive_space::haptics
