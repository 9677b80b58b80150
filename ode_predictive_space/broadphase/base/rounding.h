// Conversion of double to single precision, rounded to a known side.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_ROUNDING_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_ROUNDING_H

#include <cmath>
#include <limits>

namespace ode_predictive_space
{
/// A float <= value, at most three units in the last place below it, or FLT_MIN where that is more. -infinity when value is
/// NaN or below the range of float.
inline float round_down(double value)
{
    // One part in 2^23 is one or two units in the last place. FLT_MIN covers numbers too small for that, also where the
    // processor flushes denormal numbers to zero.
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

/// A float >= value, likewise. Infinity when value is NaN or above the range of float.
inline float round_up(double value)
{
    return -round_down(-value);
}
} // namespace ode_predictive_space

#endif
