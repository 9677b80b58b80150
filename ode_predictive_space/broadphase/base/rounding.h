// Directed rounding from double to single precision.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_ROUNDING_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_ROUNDING_H

#include <cmath>
#include <limits>

namespace ode_predictive_space
{
/// A float <= value, at most three units in the last place or FLT_MIN below it; -infinity for NaN and below the range of float.
inline float round_down(double value)
{
    // One part in 2^23 is one or two units in the last place. FLT_MIN covers smaller numbers, also if denormals become zero.
    constexpr float unit = std::numeric_limits<float>::epsilon();
    if (std::isnan(value))
        return -std::numeric_limits<float>::infinity();
    const float nearest = static_cast<float>(value);
    if (!(static_cast<double>(nearest) > value))
        return nearest;
    if (nearest > std::numeric_limits<float>::max())
        return std::numeric_limits<float>::max();
    return nearest - (std::abs(nearest) * unit + std::numeric_limits<float>::min());
}

/// A float >= value, with the same bounds; infinity for NaN and above the range of float.
inline float round_up(double value)
{
    return -round_down(-value);
}
} // namespace ode_predictive_space

#endif
