// Random numbers (splitmix64) whose distributions are the same with each standard library.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_RANDOM_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_RANDOM_H

#include "ode_predictive_space/haptics/device.h"

#include <cmath>
#include <cstdint>

namespace ode_predictive_space::haptics
{
constexpr double full_turn = 2 * 3.14159265358979323846; ///< radians

/// Mixes the bits of a number by a bijection (the finaliser of splitmix64).
inline std::uint64_t mix_bits(std::uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

class Random
{
public:
    explicit Random(std::uint64_t seed) : state_(mix_bits(seed)) {}

    static Random from(std::uint64_t state)
    {
        Random random(0);
        random.state_ = state;
        return random;
    }

    std::uint64_t state() const { return state_; }

    std::uint64_t bits() { return mix_bits(state_ += 0x9e3779b97f4a7c15u); }

    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

    double uniform(double low, double high) { return low + (high - low) * unit(); }

    std::size_t index(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }

    Vector3 in_box(const Vector3 &half)
    {
        const double x = uniform(-half.x(), half.x());
        const double y = uniform(-half.y(), half.y());
        const double z = uniform(-half.z(), half.z());
        return {x, y, z};
    }

    Vector3 direction()
    {
        const double z = uniform(-1, 1);
        const double angle = uniform(0, full_turn);
        const double radius = std::sqrt(1 - z * z);
        return {radius * std::cos(angle), radius * std::sin(angle), z};
    }

    Quaternion orientation()
    {
        const Vector3 axis = direction();
        return Quaternion(Eigen::AngleAxisd(uniform(0, full_turn), axis));
    }

private:
    std::uint64_t state_;
};
} // namespace ode_predictive_space::haptics

#endif
