// A hand that moves a haptic probe by reaches of least jerk, with tremor: its path, and the device that it holds.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_HAND_PATH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_HAND_PATH_H

#include "ode_predictive_space/haptics/device.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace ode_predictive_space::haptics
{
constexpr double full_turn = 2 * 3.14159265358979323846; ///< radians

/// Spreads the bits of a number: a bijection without visible structure (the finaliser of splitmix64).
inline std::uint64_t mix_bits(std::uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// A stream of random numbers (splitmix64). The distributions of the standard library differ between libraries, these do not.
class Random
{
public:
    /// The same seed gives the same stream; any will do.
    explicit Random(std::uint64_t seed) : state_(mix_bits(seed)) {}

    /// 64 random bits.
    std::uint64_t bits() { return mix_bits(state_ += 0x9e3779b97f4a7c15u); }

    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * unit(); }

    /// Uniform in 0 … count - 1.
    std::size_t index(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }

    /// Uniform in the box [-half, half].
    Vector3 in_box(const Vector3 &half)
    {
        const double x = uniform(-half.x(), half.x());
        const double y = uniform(-half.y(), half.y());
        const double z = uniform(-half.z(), half.z());
        return {x, y, z};
    }

    /// Uniform on the unit sphere.
    Vector3 direction()
    {
        const double z = uniform(-1, 1);
        const double angle = uniform(0, full_turn);
        const double radius = std::sqrt(1 - z * z);
        return {radius * std::cos(angle), radius * std::sin(angle), z};
    }

    /// A turn by any angle about any axis.
    Quaternion orientation()
    {
        const Vector3 axis = direction();
        return Quaternion(Eigen::AngleAxisd(uniform(0, full_turn), axis));
    }

private:
    std::uint64_t state_;
};

/// What the hand does, in its own size; `scale` maps it into the device's workspace, or into a scene.
struct HandPathSettings
{
    Vector3 centre = Vector3::Zero(); ///< middle of the workspace, metres
    double scale = 1;                 ///< metres per metre of the hand
    double half_workspace = 0.15;     ///< half the side of the cube in which the hand's targets lie, metres of the hand
    double shortest_reach = 0.1;      ///< metres of the hand
    double longest_reach = 0.3;       ///< metres of the hand
    double shortest_time = 0.3;       ///< seconds, for the shortest reach
    double longest_time = 0.8;        ///< seconds, for the longest reach
    double longest_pause = 0.2;       ///< seconds; between two reaches the hand rests up to this long
    double tremor = 0.0002;           ///< largest tremor along each axis, metres of the hand
};

/// Position of the hand at any time.
///
/// A reach from A to B in time T follows A + (B - A) (10 u^3 - 15 u^4 + 6 u^5), u = t / T: the movement of least jerk,
/// which is how people reach (Flash and Hogan, 1985). It starts and ends at rest. Tremor is the sum of two sines of 8 to
/// 12 Hz along each axis.
class HandPath
{
public:
    /// The same settings and seed give the same path.
    HandPath(const HandPathSettings &settings, std::uint64_t seed);

    /// Where the hand is `time` seconds after the start, in metres. Not const: reaches are drawn as they are needed, up to
    /// the latest time that was asked for.
    Vector3 position(double time);

    /// position() without tremor.
    Vector3 intended_position(double time);

    /// The derivative of position(), in m/s.
    Vector3 velocity(double time);

    /// Start and end of the reach, or the pause after it, that the hand makes at this time, in seconds.
    std::array<double, 2> reach_times(double time);

    /// Draw the reaches of the first `seconds` now: until then, the other calls need no memory.
    void draw_ahead(double seconds = 600);

    /// Nothing that position() returns is farther from the centre than this along any axis, metres.
    double half_extent() const;

private:
    struct Reach
    {
        double start; ///< seconds
        double duration;
        double pause; ///< seconds of rest after it
        Vector3 from; ///< metres of the hand, from the centre
        Vector3 to;
    };

    struct Sine
    {
        double rate;  ///< radians/s
        double phase; ///< radians
    };

    const Reach &reach_at(double time);
    Vector3 draw_target(const Vector3 &from);
    void add_reach();
    template <class Value> Vector3 tremor(Value value_of) const;

    HandPathSettings settings_;
    Random random_;
    std::array<std::array<Sine, 2>, 3> tremor_;
    std::vector<Reach> reaches_; ///< in the order of time, without gaps
};

/// The handle follows a HandPath. Forces are accepted and have no effect: see VirtualDevice for a hand that gives way.
class HandPathDevice : public SoftwareDevice
{
public:
    /// The arguments are those of HandPath.
    explicit HandPathDevice(const HandPathSettings &settings = {}, std::uint64_t seed = 1);

protected:
    void start() override;
    DeviceState move_to(double seconds) override;

private:
    HandPath path_;
};
} // namespace ode_predictive_space::haptics

#endif
