#include "ode_predictive_space/haptics/recording.h"

#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double same_time = 1e-9;     // s
constexpr double longest_curve = 0.25; // s; between two ticks
constexpr double margin = 0.001;       // m; around the positions of a recording without a workspace

struct Leg
{
    Leg(const DeviceState &from, const DeviceState &to) : seconds(to.time - from.time)
    {
        velocity = (to.position - from.position) / seconds;
        Quaternion turn = to.orientation * from.orientation.conjugate();
        turn.coeffs() *= turn.w() < 0 ? -1 : 1; // the shorter rotation
        const Eigen::AngleAxisd turned(turn);
        angular_velocity = turned.angle() / seconds * turned.axis();
    }

    double seconds;
    Vector3 velocity;         // the mean, m/s
    Vector3 angular_velocity; // the mean, rad/s
};

/// The slope, between two legs, of the parabola through their ends.
Vector3 slope_between(const Vector3 &before, double seconds_before, const Vector3 &after, double seconds_after)
{
    return (seconds_after * before + seconds_before * after) / (seconds_before + seconds_after);
}

// At both ends of the recording, the single leg counts twice.
void derive_velocities(std::vector<RecordedTick> &ticks)
{
    const std::size_t last = ticks.size() - 1;
    for (std::size_t i = 0; i <= last && last > 0; ++i)
    {
        const Leg before(ticks[i > 0 ? i - 1 : 0].state, ticks[i > 0 ? i : 1].state);
        const Leg after(ticks[i < last ? i : last - 1].state, ticks[i < last ? i + 1 : last].state);
        DeviceState &state = ticks[i].state;
        state.linear_velocity = slope_between(before.velocity, before.seconds, after.velocity, after.seconds);
        state.angular_velocity =
            slope_between(before.angular_velocity, before.seconds, after.angular_velocity, after.seconds);
    }
}

Capabilities capabilities_without_device(const std::vector<RecordedTick> &ticks)
{
    Capabilities capabilities;
    capabilities.input_axes = 6;
    capabilities.force_axes = 0;
    capabilities.workspace.setEmpty();
    for (const RecordedTick &tick : ticks)
        capabilities.workspace.extend(tick.state.position);
    capabilities.workspace.min().array() -= margin;
    capabilities.workspace.max().array() += margin;
    const double duration = ticks.back().state.time - ticks.front().state.time;
    if (duration > 0)
        capabilities.rate = static_cast<double>(ticks.size() - 1) / duration;
    return capabilities;
}
} // namespace

ReplayDevice::ReplayDevice(const std::string &file) : SoftwareDevice("replay of " + file, 6), file_(file) {}

ReplayDevice::ReplayDevice(Recording recording) : SoftwareDevice("replay of a run", 6)
{
    if (recording.ticks.empty())
        throw std::invalid_argument("replay: the recording has no ticks");
    take_in(std::move(recording));
}

void ReplayDevice::start()
{
    if (!file_.empty())
        take_in(read_recording(file_));
    tick_ = 0;
    ended_ = false;
}

void ReplayDevice::take_in(Recording recording)
{
    const std::string name = capabilities_.name;
    recording_ = std::move(recording);
    capabilities_ = recording_.device ? *recording_.device : capabilities_without_device(recording_.ticks);
    capabilities_.name = name;
    if (!recording_.has_velocities)
        derive_velocities(recording_.ticks);
}

DeviceState ReplayDevice::move_to(double seconds)
{
    const std::size_t last = recording_.ticks.size() - 1;
    while (tick_ < last && seconds_at(tick_ + 1) <= seconds + same_time)
        ++tick_;
    const DeviceState &state = recording_.ticks[tick_].state;
    if (std::abs(seconds_at(tick_) - seconds) <= same_time)
        return state;
    if (tick_ < last)
        return between(seconds);
    ended_ = true;
    DeviceState at_rest = state;
    at_rest.linear_velocity.setZero();
    at_rest.angular_velocity.setZero();
    return at_rest;
}

// Relative to the first tick, so that differences are the same numbers as in the run.
double ReplayDevice::seconds_at(std::size_t tick) const
{
    return recording_.ticks[tick].state.time - recording_.ticks.front().state.time;
}

DeviceState ReplayDevice::between(double seconds) const
{
    const DeviceState &from = recording_.ticks[tick_].state;
    const DeviceState &to = recording_.ticks[tick_ + 1].state;
    const double duration = to.time - from.time;
    const double u = (seconds - seconds_at(tick_)) / duration;
    const double curving = duration <= longest_curve ? duration : 0;
    const Vector3 way = to.position - from.position;
    const Vector3 leave = curving * from.linear_velocity;
    const Vector3 arrive = curving * to.linear_velocity;
    const Vector3 square = 3 * way - 2 * leave - arrive;
    const Vector3 cube = leave + arrive - 2 * way;

    DeviceState state = from;
    state.position = from.position + u * (leave + u * (square + u * cube));
    state.linear_velocity = (leave + u * (2 * square + 3 * u * cube)) / duration;
    state.orientation = from.orientation.slerp(u, to.orientation);
    state.angular_velocity = from.angular_velocity + u * (to.angular_velocity - from.angular_velocity);
    return state;
}

std::string ReplayDevice::idle_reason() const
{
    return ended_ ? capabilities_.name + ": the recording has ended" : std::string();
}
} // namespace ode_predictive_space::haptics
