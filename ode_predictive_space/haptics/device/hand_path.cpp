#include "ode_predictive_space/haptics/hand_path.h"

#include "ode_predictive_space/haptics/device/random.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
double least_jerk(double u)
{
    return u * u * u * (10 + u * (-15 + 6 * u));
}

double least_jerk_slope(double u)
{
    return 30 * u * u * (1 - u) * (1 - u);
}

// Draws until the target is in the workspace; a reach of up to its side fits in some direction.
Vector3 draw_target(const HandPathSettings &settings, const Vector3 &from, Random &random)
{
    while (true)
    {
        const double length = random.uniform(settings.shortest_reach, settings.longest_reach);
        Vector3 target = from + length * random.direction();
        if (target.cwiseAbs().maxCoeff() <= settings.half_workspace)
            return target;
    }
}
} // namespace

HandPath::HandPath(const HandPathSettings &settings, std::uint64_t seed) : settings_(settings)
{
    Random random(seed);
    for (auto &axis : tremor_)
    {
        for (Sine &sine : axis)
        {
            sine.rate = full_turn * random.uniform(8, 12);
            sine.phase = random.uniform(0, full_turn);
        }
    }
    random_ = random.state();
}

Vector3 HandPath::position(double time)
{
    const Reach &reach = reach_at(time);
    const double u = std::clamp((time - reach.start) / reach.duration, 0.0, 1.0);
    const Vector3 hand = reach.from + least_jerk(u) * (reach.to - reach.from);
    const auto sway = [time](const Sine &sine) { return std::sin(sine.rate * time + sine.phase); };
    return settings_.centre + settings_.scale * hand + settings_.scale * tremor(sway);
}

Vector3 HandPath::velocity(double time)
{
    const Reach &reach = reach_at(time);
    const double u = std::clamp((time - reach.start) / reach.duration, 0.0, 1.0);
    const Vector3 hand = least_jerk_slope(u) / reach.duration * (reach.to - reach.from);
    const auto slope = [time](const Sine &sine) { return sine.rate * std::cos(sine.rate * time + sine.phase); };
    return settings_.scale * (hand + tremor(slope));
}

void HandPath::draw_ahead(double seconds)
{
    reach_at(seconds);
}

double HandPath::half_extent() const
{
    return settings_.scale * (settings_.half_workspace + settings_.tremor);
}

const HandPath::Reach &HandPath::reach_at(double time)
{
    while (reaches_.empty() || time >= reaches_.back().start + reaches_.back().duration + reaches_.back().pause)
        add_reach();
    const auto after = std::upper_bound(reaches_.begin() + 1, reaches_.end(), time,
                                        [](double t, const Reach &reach) { return t < reach.start; });
    return *(after - 1);
}

void HandPath::add_reach()
{
    Random random = Random::from(random_);
    Reach reach;
    reach.start = reaches_.empty() ? 0 : reaches_.back().start + reaches_.back().duration + reaches_.back().pause;
    reach.from = reaches_.empty() ? Vector3::Zero() : reaches_.back().to;
    reach.to = draw_target(settings_, reach.from, random);
    const double share = ((reach.to - reach.from).norm() - settings_.shortest_reach) /
                         (settings_.longest_reach - settings_.shortest_reach);
    reach.duration = settings_.shortest_time + share * (settings_.longest_time - settings_.shortest_time);
    reach.pause = random.uniform(0, settings_.longest_pause);
    random_ = random.state();
    reaches_.push_back(reach);
}

template <class Value> Vector3 HandPath::tremor(Value value_of) const
{
    Vector3 sum = Vector3::Zero();
    for (int axis = 0; axis < 3; ++axis)
        for (const Sine &sine : tremor_[static_cast<std::size_t>(axis)])
            sum[axis] += value_of(sine);
    return 0.5 * settings_.tremor * sum;
}

HandPathDevice::HandPathDevice(const HandPathSettings &settings, std::uint64_t seed)
    : SoftwareDevice("hand path", 3), path_(settings, seed)
{
    const Vector3 half = Vector3::Constant(path_.half_extent());
    capabilities_.workspace = {settings.centre - half, settings.centre + half};
}

void HandPathDevice::start()
{
    path_.draw_ahead();
}

DeviceState HandPathDevice::move_to(double seconds)
{
    DeviceState state;
    state.position = path_.position(seconds);
    state.linear_velocity = path_.velocity(seconds);
    return state;
}
} // namespace ode_predictive_space::haptics
