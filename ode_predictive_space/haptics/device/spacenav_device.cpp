#include "ode_predictive_space/haptics/drivers.h"

#include "ode_predictive_space/haptics/device/check_argument.h"
#include "ode_predictive_space/haptics/device/spnav_connection.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
SpacenavSettings checked(const SpacenavSettings &settings)
{
    check_positive(settings.speed, "SpacenavSettings: speed");
    check_positive(settings.turn_rate, "SpacenavSettings: turn_rate");
    check_positive(settings.workspace_extent, "SpacenavSettings: workspace_extent");
    if (!(settings.dead_zone >= 0 && settings.dead_zone < 1))
        refuse(settings.dead_zone, "SpacenavSettings: dead_zone", "at least 0 and below 1");
    return settings;
}

Quaternion turned(const Quaternion &orientation, const Vector3 &angle)
{
    const double size = angle.norm();
    return size > 0 ? Quaternion((Eigen::AngleAxisd(size, angle / size) * orientation).normalized()) : orientation;
}

/// Velocity from counts: zero in the dead zone, linear from its border to `full` at full deflection.
Vector3 velocity_of(const Vector3 &counts, double dead_zone, double full)
{
    const auto rate_of = [&](double count) {
        const double deflection = std::min(std::abs(count) / SpacenavDevice::full_deflection, 1.0);
        const double beyond = std::max(deflection - dead_zone, 0.0) / (1 - dead_zone);
        return std::copysign(beyond * full, count);
    };
    return counts.unaryExpr(rate_of);
}

void move(DeviceState &state, const Vector3 &velocity, double step, double wall)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        const double position = std::clamp(state.position[axis] + velocity[axis] * step, -wall, wall);
        const bool is_stopped = std::abs(position) >= wall && position * velocity[axis] > 0;
        state.position[axis] = position;
        state.linear_velocity[axis] = is_stopped ? 0 : velocity[axis];
    }
}
} // namespace

struct SpacenavDevice::Session
{
    SpnavConnection connection;
    SpnavInput input;
    DeviceState state;
    double seconds = 0;
    std::string loss; ///< reason; empty while connected
};

SpacenavDevice::SpacenavDevice(const SpacenavSettings &settings)
    : SoftwareDevice("3D mouse", 6,
                     {Vector3::Constant(-settings.workspace_extent), Vector3::Constant(settings.workspace_extent)}),
      settings_(checked(settings))
{}

SpacenavDevice::~SpacenavDevice() = default;

void SpacenavDevice::start()
{
    session_ = std::make_unique<Session>();
    capabilities_.name = session_->connection.mouse();
}

void SpacenavDevice::close() noexcept
{
    session_.reset();
    SoftwareDevice::close();
}

DeviceState SpacenavDevice::move_to(double seconds)
{
    check_connection();
    try
    {
        session_->connection.receive(session_->input);
    }
    catch (const DeviceError &error)
    {
        session_->loss = error.what();
        throw;
    }
    const SpnavInput &input = session_->input;
    DeviceState &state = session_->state;
    const double step = std::min(seconds - session_->seconds, longest_step);
    session_->seconds = seconds;
    state.buttons = input.buttons;
    state.angular_velocity = velocity_of(input.rotation, settings_.dead_zone, settings_.turn_rate);
    state.orientation = turned(state.orientation, state.angular_velocity * step);
    move(state, velocity_of(input.translation, settings_.dead_zone, settings_.speed), step, settings_.workspace_extent);
    return state;
}

void SpacenavDevice::write(const Wrench &wrench)
{
    SoftwareDevice::write(wrench);
    check_connection();
}

std::string SpacenavDevice::idle_reason() const
{
    return session_->loss;
}

void SpacenavDevice::check_connection() const
{
    if (!session_->loss.empty())
        throw DeviceError(DeviceFault::lost, session_->loss);
}

} // namespace ode_predictive_space::haptics
