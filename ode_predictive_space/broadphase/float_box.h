// Boxes in single precision, rounded outwards: what the index stores and compares.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_FLOAT_BOX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_FLOAT_BOX_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// A float <= value, at most three units in the last place below it, or FLT_MIN where that is more; -infinity when value is
/// NaN or below the range of float.
inline float round_down(double value)
{
    // Written so that no branch hangs on which way the conversion rounds: it would be mispredicted half of the time. One
    // part in 2^23 is one or two units in the last place; FLT_MIN does for numbers too small for that, also where the
    // processor takes denormal numbers for zero.
    constexpr float unit = std::numeric_limits<float>::epsilon();
    const float nearest = static_cast<float>(value);
    float margin = std::abs(nearest) * unit + std::numeric_limits<float>::min();
    std::uint32_t bits;
    std::memcpy(&bits, &margin, sizeof bits);
    bits &= 0u - static_cast<std::uint32_t>(nearest > value);
    std::memcpy(&margin, &bits, sizeof bits);
    const float lowered = nearest - margin;
    if (lowered == lowered)
        return lowered;
    return value > 0 ? std::numeric_limits<float>::max() : -std::numeric_limits<float>::infinity();
}

/// A float >= value, likewise; infinity when value is NaN or above the range of float.
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

    bool operator==(const FloatBox &other) const
    {
        return std::equal(low, low + 3, other.low) && std::equal(high, high + 3, other.high);
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
/// A box that is compared with many others: overlaps() in two vector comparisons where the machine has them.
class BoxProbe
{
public:
#if defined(__SSE2__)
    explicit BoxProbe(const FloatBox &box)
        : high_(_mm_setr_ps(box.high[0], box.high[1], box.high[2], infinity)),
          low_(_mm_setr_ps(-infinity, box.low[0], box.low[1], box.low[2]))
    {}

    // The two loads overlap by two components, so that neither leaves the other box; its odd ones are compared with
    // infinity.
    bool overlaps(const FloatBox &other) const
    {
        const __m128 begins = _mm_cmple_ps(_mm_loadu_ps(other.low), high_);
        const __m128 ends = _mm_cmple_ps(low_, _mm_loadu_ps(other.low + 2));
        return _mm_movemask_ps(_mm_and_ps(begins, ends)) == 15;
    }

private:
    static constexpr float infinity = std::numeric_limits<float>::infinity();
    __m128 high_, low_;
#else
    explicit BoxProbe(const FloatBox &box) : box_(box) {}
    bool overlaps(const FloatBox &other) const
    {
        return box_.overlaps(other);
    }

private:
    FloatBox box_;
#endif
};
static_assert(sizeof(FloatBox) == 6 * sizeof(float), "BoxProbe reads low and high as one array");
} // namespace ode_predictive_space

#endif
