// Boxes in single precision, rounded outwards: what the index stores and compares.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_FLOAT_BOX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_FLOAT_BOX_H

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// A float <= value, at most three units in the last place below it; -infinity when value is NaN or below float's range.
inline float round_down(double value)
{
    // One part in 2^23 is one or two units in the last place; the smallest float does for numbers too small for that.
    constexpr float unit = std::numeric_limits<float>::epsilon();
    const float nearest = static_cast<float>(value);
    if (nearest <= value)
        return nearest;
    if (std::isinf(nearest))
        return std::numeric_limits<float>::max();
    return nearest > value ? nearest - (std::abs(nearest) * unit + std::numeric_limits<float>::denorm_min())
                           : -std::numeric_limits<float>::infinity();
}

/// A float >= value, likewise; infinity when value is NaN or above float's range.
inline float round_up(double value)
{
    return -round_down(-value);
}

/// An axis-aligned box that holds the double-precision box it was made of. Closed: touching boxes overlap.
struct FloatBox
{
    float low[3];
    float high[3];

    static FloatBox around(const Box &box)
    {
        FloatBox result;
        for (int axis = 0; axis < 3; ++axis)
        {
            result.low[axis] = round_down(box.min()[axis]);
            result.high[axis] = round_up(box.max()[axis]);
        }
        return result;
    }

    bool overlaps(const FloatBox &other) const
    {
        return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
               other.low[1] <= high[1] && low[2] <= other.high[2] && other.low[2] <= high[2];
    }

    bool contains(const FloatBox &other) const
    {
        return low[0] <= other.low[0] && low[1] <= other.low[1] && low[2] <= other.low[2] && other.high[0] <= high[0] &&
               other.high[1] <= high[1] && other.high[2] <= high[2];
    }

    FloatBox merged(const FloatBox &other) const
    {
        FloatBox result;
        for (int axis = 0; axis < 3; ++axis)
        {
            result.low[axis] = std::min(low[axis], other.low[axis]);
            result.high[axis] = std::max(high[axis], other.high[axis]);
        }
        return result;
    }

    /// Half the surface area: the cost measure of a tree node.
    float half_area() const
    {
        const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
        return x * y + y * z + z * x;
    }

    /// False when a side is infinite or so far away that areas overflow: such a box would spoil a tree.
    bool bounded() const
    {
        constexpr float limit = 1e15f;
        for (int axis = 0; axis < 3; ++axis)
            if (!(low[axis] > -limit && high[axis] < limit && high[axis] > -limit && low[axis] < limit))
                return false;
        return true;
    }
};
} // namespace ode_predictive_space

#endif
