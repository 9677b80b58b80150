#include "ode_predictive_space/haptics/virtual_device.h"

#include "ode_predictive_space/haptics/device/check_argument.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double longest_straight_step = 0.0002; // s; the target path is linear in such a step

Capabilities preset(const char *name, double force, double stiffness, double damping, double radius)
{
    Capabilities capabilities;
    capabilities.name = name;
    capabilities.max_force = force;
    capabilities.max_stiffness = stiffness;
    capabilities.max_damping = damping;
    capabilities.workspace = {Vector3::Constant(-radius), Vector3::Constant(radius)};
    return capabilities;
}

void check(const VirtualDeviceSettings &settings)
{
    check_positive(settings.hand.mass, "virtual device: the hand's mass");
    check_not_negative(settings.hand.damping, "virtual device: the device's damping");
    check_not_negative(settings.hand.grip_stiffness, "virtual device: the grip's stiffness");
    check_not_negative(settings.hand.grip_damping, "virtual device: the grip's damping");
    check_not_negative(settings.encoder_step, "virtual device: the encoders' step");
    check_positive(settings.velocity_cutoff, "virtual device: the velocity filter's cut-off frequency");
    check_not_negative(settings.position_delay, "virtual device: the position's delay");
    check_not_negative(settings.force_delay, "virtual device: the force's delay");
}

/// e^matrix, by Taylor's series of a matrix halved until it is small, squared as often.
Eigen::Matrix4d exponential(Eigen::Matrix4d matrix)
{
    int halvings = 0;
    for (; matrix.cwiseAbs().rowwise().sum().maxCoeff() > 0.25; ++halvings)
        matrix *= 0.5;
    Eigen::Matrix4d sum = Eigen::Matrix4d::Identity();
    Eigen::Matrix4d term = Eigen::Matrix4d::Identity();
    for (int n = 1; n <= 12; ++n)
    {
        term = term * matrix / n;
        sum += term;
    }
    for (; halvings > 0; --halvings)
        sum = sum * sum;
    return sum;
}

/// How position, velocity and drive u change in `step` seconds, for x'' = u - damping / mass x' - stiffness / mass x, with
/// u changing evenly: the fourth component is u'.
Eigen::Matrix4d transition(const HandModel &hand, double step)
{
    Eigen::Matrix4d rates = Eigen::Matrix4d::Zero();
    rates(0, 1) = 1;
    rates(1, 0) = -hand.grip_stiffness / hand.mass;
    rates(1, 1) = -(hand.damping + hand.grip_damping) / hand.mass;
    rates(1, 2) = 1;
    rates(2, 3) = 1;
    return exponential(step * rates);
}
} // namespace

const std::vector<Capabilities> &device_presets()
{
    static const std::vector<Capabilities> presets = {
        preset("PHANToM Desktop", 7.9, 1000, 5, 0.10), preset("PHANToM Omni", 3.3, 700, 5, 0.10),
        preset("Touch", 3.3, 400, 4, 0.075),           preset("omega.3", 12, 5000, 30, 0.075),
        preset("Falcon", 8, 3000, 20, 0.04),
    };
    return presets;
}

const Capabilities &device_preset(const std::string &name)
{
    std::string names;
    for (const Capabilities &preset : device_presets())
    {
        if (preset.name == name)
            return preset;
        names += (names.empty() ? "" : ", ") + preset.name;
    }
    throw std::invalid_argument("no device preset is called \"" + name + "\"; the names are: " + names);
}

VirtualDevice::VirtualDevice(const VirtualDeviceSettings &settings, TargetPath target)
    : SoftwareDevice(settings.capabilities), settings_(settings), target_(std::move(target))
{
    check(settings);
    if (!target_)
        throw std::invalid_argument("virtual device: the hand has no target");
    capabilities_.name = "virtual " + capabilities_.name;
    if (capabilities_.rate > 0)
    {
        capabilities_.delay =
            std::max(capabilities_.delay, (settings.position_delay + settings.force_delay) / capabilities_.rate);
    }
    VirtualDevice::start();
}

void VirtualDevice::start()
{
    seconds_ = 0;
    target_position_ = target_(0);
    position_ = target_position_;
    velocity_.setZero();
    rendered_.assign(static_cast<std::size_t>(settings_.force_delay) + 1, Vector3::Zero());
    DeviceState at_rest;
    at_rest.position = quantised(position_);
    readings_.assign(static_cast<std::size_t>(settings_.position_delay) + 1, at_rest);
}

DeviceState VirtualDevice::move_to(double seconds)
{
    const double elapsed = seconds - seconds_;
    move_hand(seconds);
    measure(elapsed);
    // The next write() sets the last of the row; until then, the last force continues.
    std::rotate(rendered_.begin(), rendered_.begin() + 1, rendered_.end());
    rendered_.back() = limited(last_wrench().force);
    return readings_.front();
}

void VirtualDevice::write(const Wrench &wrench)
{
    rendered_.back().setZero(); // for a refused wrench
    SoftwareDevice::write(wrench);
    rendered_.back() = limited(wrench.force);
}

void VirtualDevice::move_hand(double seconds)
{
    const double duration = seconds - seconds_;
    if (duration <= 0)
        return;
    const double start = seconds_;
    const int steps = static_cast<int>(std::ceil(duration / longest_straight_step - 1e-6));
    const Transition change = transition(settings_.hand, duration / steps);
    for (int step = 1; step <= steps; ++step)
        move_hand_by(change, step == steps ? seconds : start + duration * step / steps);
}

void VirtualDevice::move_hand_by(const Transition &change, double seconds)
{
    const HandModel &hand = settings_.hand;
    const double step = seconds - seconds_;
    const Vector3 target = target_(seconds);
    const Vector3 target_velocity = (target - target_position_) / step;
    Eigen::Matrix<double, 4, 3> state;
    state.row(0) = position_;
    state.row(1) = velocity_;
    state.row(2) =
        (rendered_.front() + hand.grip_stiffness * target_position_ + hand.grip_damping * target_velocity) / hand.mass;
    state.row(3) = hand.grip_stiffness * target_velocity / hand.mass;
    state = (change * state).eval();
    position_ = state.row(0);
    velocity_ = state.row(1);
    target_position_ = target;
    seconds_ = seconds;
}

void VirtualDevice::measure(double elapsed)
{
    const DeviceState before = readings_.back();
    DeviceState now = before;
    now.position = quantised(position_);
    if (elapsed > 0)
    {
        const double weight = elapsed / (elapsed + 1 / (2 * static_cast<double>(EIGEN_PI) * settings_.velocity_cutoff));
        now.linear_velocity += weight * ((now.position - before.position) / elapsed - before.linear_velocity);
    }
    std::rotate(readings_.begin(), readings_.begin() + 1, readings_.end());
    readings_.back() = now;
}

Vector3 VirtualDevice::quantised(const Vector3 &position) const
{
    const double step = settings_.encoder_step;
    return step > 0 ? Vector3((position / step).array().round() * step) : position;
}

Vector3 VirtualDevice::limited(const Vector3 &force) const
{
    const double size = force.norm();
    return size > capabilities_.max_force ? Vector3(force * (capabilities_.max_force / size)) : force;
}
} // namespace ode_predictive_space::haptics
