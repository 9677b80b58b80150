#include "ode_predictive_space/haptics/loop/hand_impulses.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::size_t most_shares = 2 * ContactModel::capacity;
constexpr std::uint64_t unnumbered = ~std::uint64_t{0};
} // namespace

HandImpulses::HandImpulses(std::size_t most, double start) : queue_(most), rendered_due_(start)
{
    given_.reserve(most + most_shares);
    held_.reserve(most_shares);
}

void HandImpulses::foresee(const MotionForecast &forecast, const ContactModel &planes, double due,
                           ContactModel::Shifts &shifts)
{
    given_.erase(given_.begin(), std::find_if(given_.begin(), given_.end(), [&](const Impulse &impulse) {
                     return impulse.number > forecast.last_included();
                 }));
    const std::size_t known = given_.size();
    for (const ForceShare &share : held_)
        given_.push_back({share.object, share.point, (due - rendered_due_) * share.force, rendered_due_, unnumbered});
    forecast.shift(given_, due, planes, shifts);
    given_.resize(known);
}

void HandImpulses::settle(double now, const DeviceGate &gate, const std::vector<ForceShare> &shares)
{
    const std::uint64_t zeros = gate.zeros();
    const bool guard_took_it = zeros != zeros_; // the servo has hung since
    const double held_until = guard_took_it ? std::clamp(gate.last_zero(), settled_, now) : now;
    for (const ForceShare &share : held_)
        give(share, held_until - settled_);
    zeros_ = zeros;
    settled_ = now;
    held_ = shares;
    if (guard_took_it)
        held_.clear();
}

/// The tick began when it was due: then the scene's semi-implicit steps and the forecast are of one kind, and create no energy.
void HandImpulses::give(const ForceShare &share, double seconds)
{
    const Impulse impulse = {share.object, share.point, seconds * share.force, rendered_due_, ++numbered_};
    if (queue_.give(impulse) && given_.size() + held_.size() < given_.capacity())
        given_.push_back(impulse);
}
} // namespace ode_predictive_space::haptics
