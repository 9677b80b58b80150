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
} // namespace

/// From open() to close().
class SpacenavDevice::Session
{
public:
    explicit Session(const SpacenavSettings &settings) : settings_(settings), connection_(connect_to_spacenavd()) {}

    std::string mouse() const { return connection_->mouse(); }
    const std::string &loss() const { return loss_; }

    DeviceState read(double time)
    {
        receive();
        const double step = has_time_ ? std::clamp(time - state_.time, 0.0, longest_step) : 0;
        has_time_ = true;
        state_.time = time;
        state_.buttons = input_.buttons;
        state_.angular_velocity = rate(input_.rotation, settings_.turn_rate);
        state_.orientation = turned(state_.orientation, state_.angular_velocity * step);
        move(rate(input_.translation, settings_.speed), step);
        return state_;
    }

    /// @throws DeviceError when the mouse is lost.
    void check() const
    {
        if (!loss_.empty())
            throw DeviceError(DeviceFault::lost, loss_);
    }

private:
    void receive()
    {
        check();
        try
        {
            connection_->receive(input_);
        }
        catch (const DeviceError &error)
        {
            loss_ = error.what();
            throw;
        }
    }

    /// From counts to a velocity: none within the dead zone, growing steadily from its border, `full` at full
    /// deflection.
    Vector3 rate(const Vector3 &counts, double full) const
    {
        const auto rate_of = [&](double count) {
            const double deflection = std::min(std::abs(count) / full_deflection, 1.0);
            const double beyond = std::max(deflection - settings_.dead_zone, 0.0) / (1 - settings_.dead_zone);
            return std::copysign(beyond * full, count);
        };
        return counts.unaryExpr(rate_of);
    }

    /// A wall of the workspace stops the motion towards it.
    void move(const Vector3 &velocity, double step)
    {
        const double wall = settings_.workspace_extent;
        for (int axis = 0; axis < 3; ++axis)
        {
            const double position = std::clamp(state_.position[axis] + velocity[axis] * step, -wall, wall);
            const bool is_stopped = std::abs(position) >= wall && position * velocity[axis] > 0;
            state_.position[axis] = position;
            state_.linear_velocity[axis] = is_stopped ? 0 : velocity[axis];
        }
    }

    const SpacenavSettings settings_;
    std::unique_ptr<SpnavConnection> connection_;
    SpnavInput input_;
    DeviceState state_;
    bool has_time_ = false;
    std::string loss_; ///< empty as long as there is none
};

SpacenavDevice::SpacenavDevice(const SpacenavSettings &settings) : settings_(checked(settings))
{
    capabilities_.name = "3D mouse";
    capabilities_.input_axes = 6;
    capabilities_.force_axes = 0;
    capabilities_.workspace = {Vector3::Constant(-settings_.workspace_extent),
                               Vector3::Constant(settings_.workspace_extent)};
}

SpacenavDevice::~SpacenavDevice() = default;

void SpacenavDevice::open()
{
    if (session_ == nullptr)
    {
        session_ = std::make_unique<Session>(settings_);
        capabilities_.name = session_->mouse();
    }
}

void SpacenavDevice::close() noexcept
{
    session_.reset();
}

DeviceState SpacenavDevice::read(double time)
{
    if (session_ == nullptr)
        throw DeviceError(DeviceFault::not_open, "3D mouse: read() needs open()");
    return session_->read(time);
}

void SpacenavDevice::write(const Wrench &)
{
    if (session_ == nullptr)
        throw DeviceError(DeviceFault::not_open, "3D mouse: write() needs open()");
    session_->check();
}

DeviceStatus SpacenavDevice::status() const
{
    if (session_ == nullptr)
        return {false, false, "the device is not open"};
    return {true, session_->loss().empty(), session_->loss()};
}
} // namespace ode_predictive_space::haptics
