// Boxes in single precision, rounded outwards: what the index stores and compares.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_FLOAT_BOX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_FLOAT_BOX_H

#include <algorithm>
#include <cmath>
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
    // One part in 2^23 is one or two units in the last place; FLT_MIN does for numbers too small for that, also where the
    // processor takes denormal numbers for zero.
    constexpr float unit = std::numeric_limits<float>::epsilon();
    const float nearest = static_cast<float>(value);
    const float margin = std::abs(nearest) * unit + std::numeric_limits<float>::min();
    const float lowered = nearest - (nearest > value ? margin : 0.0f);
    if (lowered == lowered)
        return lowered;
    return value > 0 ? std::numeric_limits<float>::max() : -std::numeric_limits<float>::infinity();
}

/// A float >= value, likewise; infinity when value is NaN or above the range of float.
inline float round_up(double value)
{
    return -round_down(-value);
}

#if defined(__SSE2__)
/// Without a branch that hangs on which way a conversion rounds, as it would be mispredicted half of the time:
/// round_down() of sign times each of three values, at once.
///
/// @return false, and nothing of use, when one of them is not finite as a float.
inline bool round_three_down(const double *values, double sign, __m128 &result)
{
    const __m128d signs = _mm_set1_pd(sign);
    const __m128d xy = _mm_mul_pd(_mm_loadu_pd(values), signs);
    const __m128d z = _mm_mul_pd(_mm_load_sd(values + 2), signs);
    const __m128 nearest = _mm_movelh_ps(_mm_cvtpd_ps(xy), _mm_cvtpd_ps(z));
    const __m128 size = _mm_andnot_ps(_mm_set1_ps(-0.0f), nearest);
    const __m128 unit = _mm_set1_ps(std::numeric_limits<float>::epsilon());
    const __m128 margin = _mm_add_ps(_mm_mul_ps(size, unit), _mm_set1_ps(std::numeric_limits<float>::min()));
    const __m128d above_xy = _mm_cmpgt_pd(_mm_cvtps_pd(nearest), xy);
    const __m128d above_z = _mm_cmpgt_pd(_mm_cvtps_pd(_mm_movehl_ps(nearest, nearest)), z);
    const __m128 above = _mm_shuffle_ps(_mm_castpd_ps(above_xy), _mm_castpd_ps(above_z), _MM_SHUFFLE(2, 0, 2, 0));
    result = _mm_sub_ps(nearest, _mm_and_ps(above, margin));
    return _mm_movemask_ps(_mm_cmple_ps(size, _mm_set1_ps(std::numeric_limits<float>::max()))) == 15;
}
#endif

/// An axis-aligned box that holds the double-precision box it was made of. Closed: touching boxes overlap.
struct FloatBox
{
    float low[3];
    float high[3];

    static FloatBox around(const Box &box)
    {
        FloatBox result;
#if defined(__SSE2__)
        __m128 low, high;
        if (round_three_down(box.min().data(), 1, low) && round_three_down(box.max().data(), -1, high))
        {
            // Each store writes four floats: the fourth of the first is overwritten by the second.
            _mm_storeu_ps(result.low, low);
            const __m128 upper = _mm_sub_ps(_mm_setzero_ps(), high);
            _mm_storel_pi(reinterpret_cast<__m64 *>(result.high), upper);
            _mm_store_ss(result.high + 2, _mm_movehl_ps(upper, upper));
            return result;
        }
#endif
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
#if defined(__SSE2__)
        // low[2] and high[0] are in both: each store leaves the other's alone.
        const __m128 lows = merged_lows(other);
        _mm_storeu_ps(result.low + 2, merged_highs(other));
        _mm_storel_pi(reinterpret_cast<__m64 *>(result.low), lows);
        _mm_store_ss(result.low + 2, _mm_movehl_ps(lows, lows));
#else
        for (int axis = 0; axis < 3; ++axis)
        {
            result.low[axis] = std::min(low[axis], other.low[axis]);
            result.high[axis] = std::max(high[axis], other.high[axis]);
        }
#endif
        return result;
    }

    /// Half the surface area: the cost measure of a tree node.
    float half_area() const
    {
        return merged_half_area(*this);
    }

    /// The same of merged(other), which is never written down.
    float merged_half_area(const FloatBox &other) const
    {
#if defined(__SSE2__)
        const __m128 highs = merged_highs(other);
        const __m128 sides = _mm_sub_ps(_mm_shuffle_ps(highs, highs, _MM_SHUFFLE(3, 3, 2, 1)),
                                        merged_lows(other)); // x, y, z, and nothing
        const __m128 faces = _mm_mul_ps(sides, _mm_shuffle_ps(sides, sides, _MM_SHUFFLE(0, 0, 2, 1)));
        const __m128 two = _mm_add_ss(faces, _mm_shuffle_ps(faces, faces, _MM_SHUFFLE(1, 1, 1, 1)));
        return _mm_cvtss_f32(_mm_add_ss(two, _mm_movehl_ps(faces, faces)));
#else
        const FloatBox box = merged(other);
        const float x = box.high[0] - box.low[0], y = box.high[1] - box.low[1], z = box.high[2] - box.low[2];
        return x * y + y * z + z * x;
#endif
    }

    /// False when a side is infinite or so far away that areas overflow: such a box would spoil a tree.
    bool bounded() const
    {
        constexpr float limit = 1e15f;
#if defined(__SSE2__)
        // low[2] and high[0] are in both.
        const __m128 most = _mm_set1_ps(limit), no_sign = _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff));
        const __m128 lows = _mm_cmplt_ps(_mm_and_ps(_mm_loadu_ps(low), no_sign), most);
        const __m128 highs = _mm_cmplt_ps(_mm_and_ps(_mm_loadu_ps(low + 2), no_sign), most);
        return _mm_movemask_ps(_mm_and_ps(lows, highs)) == 15;
#else
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(low[axis]) < limit && std::abs(high[axis]) < limit))
                return false;
        return true;
#endif
    }

#if defined(__SSE2__)
private:
    // low[0], low[1], low[2] and what is behind them; and high[0], high[1], high[2] with what is before.
    __m128 merged_lows(const FloatBox &other) const
    {
        return _mm_min_ps(_mm_loadu_ps(low), _mm_loadu_ps(other.low));
    }
    __m128 merged_highs(const FloatBox &other) const
    {
        return _mm_max_ps(_mm_loadu_ps(low + 2), _mm_loadu_ps(other.low + 2));
    }
#endif
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

    FloatBox box() const
    {
        alignas(16) float high[4], low[4];
        _mm_store_ps(high, high_);
        _mm_store_ps(low, low_);
        return {{low[1], low[2], low[3]}, {high[0], high[1], high[2]}};
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
    FloatBox box() const
    {
        return box_;
    }

private:
    FloatBox box_;
#endif
};
static_assert(sizeof(FloatBox) == 6 * sizeof(float), "BoxProbe reads low and high as one array");
} // namespace ode_predictive_space

#endif
