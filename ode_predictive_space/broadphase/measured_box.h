// The bounding box of an object as it is now, for the test of near pairs.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_MEASURED_BOX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_MEASURED_BOX_H

#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/float_box.h"

namespace ode_predictive_space
{
/// What single precision can tell of two boxes.
enum class Comparison : int
{
    apart = -1,
    unsure = 0, ///< they are too close to tell, or one is not finite
    overlap = 1
};

/// A box in single precision that knows how far off it may be: two of them are compared in a few instructions, and only
/// those that nearly touch have to be compared in double precision.
class alignas(32) MeasuredBox
{
public:
    MeasuredBox() = default;

    explicit MeasuredBox(const Box &box)
    {
        const double sides[] = {box.min().x(), box.max().x(), box.min().y(),
                                box.max().y(), box.min().z(), box.max().z()};
        assign(sides);
    }

    /// @param sides lowest and highest x, then y, then z.
    template <typename Real> void assign(const Real sides[6])
    {
        float largest = 0, sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            low_[axis] = static_cast<float>(sides[2 * axis]);
            high_[axis] = static_cast<float>(sides[2 * axis + 1]);
            const float low_size = std::abs(low_[axis]), high_size = std::abs(high_[axis]);
            largest = std::max(largest, std::max(low_size, high_size));
            sum += low_size + high_size;
        }
        set_error(sides, largest, sum);
    }

#if defined(__SSE2__)
    /// The same in vector instructions. The sides are loaded one by one, as they were probably stored a moment ago: a wider
    /// load would have to wait for the stores.
    void assign(const double sides[6])
    {
        const __m128 low_xy = _mm_cvtpd_ps(_mm_loadh_pd(_mm_load_sd(sides), sides + 2));
        const __m128 high_xy = _mm_cvtpd_ps(_mm_loadh_pd(_mm_load_sd(sides + 1), sides + 3));
        const __m128 low = _mm_movelh_ps(low_xy, _mm_cvtpd_ps(_mm_load_sd(sides + 4)));
        const __m128 high = _mm_movelh_ps(high_xy, _mm_cvtpd_ps(_mm_load_sd(sides + 5)));
        const __m128 sign = _mm_set1_ps(-0.0f);
        const __m128 low_size = _mm_andnot_ps(sign, low), high_size = _mm_andnot_ps(sign, high);
        _mm_store_ps(low_, low);
        _mm_store_ps(high_, high);
        const __m128 larger = _mm_max_ps(low_size, high_size), sums = _mm_add_ps(low_size, high_size);
        set_error(sides, largest_of(larger), sum_of(sums));
    }
#endif

    /// A box that holds the measured one.
    FloatBox outer() const
    {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        // Differences of infinities would be NaN: what is not finite may be everywhere.
        if (!(error_ < infinity))
            return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
        FloatBox box;
        for (int axis = 0; axis < 3; ++axis)
        {
            box.low[axis] = low_[axis] - error_;
            box.high[axis] = high_[axis] + error_;
        }
        return box;
    }

#if defined(__SSE2__)
    /// Is the box within these sides, of which three components count? False, too, when that is too close to tell.
    bool inside(__m128 low, __m128 high) const
    {
        const __m128 error = _mm_set1_ps(error_);
        const __m128 above = _mm_cmpge_ps(_mm_sub_ps(_mm_load_ps(low_), low), error);
        const __m128 below = _mm_cmpge_ps(_mm_sub_ps(high, _mm_load_ps(high_)), error);
        return (_mm_movemask_ps(_mm_and_ps(above, below)) & 7) == 7;
    }
#endif

    /// Without a branch on the outcome, which is hard to foretell.
    friend Comparison compare(const MeasuredBox &one, const MeasuredBox &other)
    {
#if defined(__SSE2__)
        // In each of three components the larger of the gaps on both sides, in the fourth the sum of the errors.
        const __m128 before = _mm_sub_ps(_mm_load_ps(other.low_), _mm_load_ps(one.high_));
        const __m128 after = _mm_sub_ps(_mm_load_ps(one.low_), _mm_load_ps(other.high_));
        const __m128 gap = _mm_max_ps(before, after);
        const __m128 error = _mm_shuffle_ps(gap, gap, 0xff);
        const int apart = _mm_movemask_ps(_mm_cmpgt_ps(gap, error)) != 0;
        const int deep = _mm_movemask_ps(_mm_cmplt_ps(gap, _mm_sub_ps(_mm_setzero_ps(), error)));
        const int overlap = (deep & 7) == 7;
#else
        const float error = one.error_ + other.error_;
        int apart = 0, overlap = 1;
        for (int axis = 0; axis < 3; ++axis)
        {
            const float gap = std::max(other.low_[axis] - one.high_[axis], one.low_[axis] - other.high_[axis]);
            apart |= gap > error;
            overlap &= gap < -error;
        }
#endif
        return static_cast<Comparison>(overlap - apart);
    }

private:
    // @param sum of all sizes: too large, or not a number, when one is.
    template <typename Real> void set_error(const Real sides[6], float largest, float sum)
    {
        const bool exact = sum <= most || forgive_infinite_sides(sides, largest);
        error_ = exact ? unit * largest + least : std::numeric_limits<float>::infinity();
        minus_error_ = -error_;
    }

#if defined(__SSE2__)
    // Of the first three components; the fourth is 0.
    static float largest_of(__m128 values)
    {
        const __m128 two = _mm_max_ps(values, _mm_movehl_ps(values, values));
        return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 1)));
    }
    static float sum_of(__m128 values)
    {
        const __m128 two = _mm_add_ps(values, _mm_movehl_ps(values, values));
        return _mm_cvtss_f32(_mm_add_ss(two, _mm_shuffle_ps(two, two, 1)));
    }
#endif

    // A side that lies at infinity is known well: there is no gap. (What overflowed single precision is not known so.)
    template <typename Real> static bool forgive_infinite_sides(const Real sides[6], float &largest)
    {
        constexpr Real infinity = std::numeric_limits<Real>::infinity();
        largest = 0;
        for (int side = 0; side < 6; ++side)
        {
            const float size = std::abs(static_cast<float>(sides[side]));
            const bool lies_at_infinity = sides[side] == (side % 2 ? infinity : -infinity);
            if (!lies_at_infinity && !(size <= most))
                return false;
            largest = std::max(largest, lies_at_infinity ? 0 : size);
        }
        return true;
    }

    // Half a unit in the last place for each number, as much again for a difference of two; and what is lost below the range
    // of float.
    static constexpr float unit = 4 * std::numeric_limits<float>::epsilon();
    static constexpr float least = std::numeric_limits<float>::min();
    static constexpr float most = std::numeric_limits<float>::max();

    float low_[3];
    float error_ = std::numeric_limits<float>::infinity();
    float high_[3];
    float minus_error_ = -std::numeric_limits<float>::infinity();
};
static_assert(sizeof(MeasuredBox) == 32, "two vectors of four, low and high");
} // namespace ode_predictive_space

#endif
