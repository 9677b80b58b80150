// The bounding box of an object as it is now, for the test of near pairs.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_MEASURED_BOX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_MEASURED_BOX_H

#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/float_box.h"

namespace ode_predictive_space
{
/// What single precision can tell of two boxes.
class Comparison
{
public:
    /// @param apart a bit for each of three axes along which they are apart
    /// @param not_overlapping a bit for each along which it is not sure that they overlap, and one more that is always set
    Comparison(int apart, int not_overlapping) : bits_(16 * apart + not_overlapping) {}

    bool apart() const { return bits_ > overlapping + unsure_axes; }
    bool overlap() const { return bits_ == overlapping; }
    /// They are too close to tell, or one is not finite.
    bool unsure() const { return static_cast<unsigned>(bits_ - overlapping - 1) < unsure_axes; }

private:
    static constexpr int overlapping = 8, unsure_axes = 7;
    int bits_;
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
        float largest = 0;
        bool known = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            low_[axis] = static_cast<float>(sides[2 * axis]);
            high_[axis] = static_cast<float>(sides[2 * axis + 1]);
            const float low_size = std::abs(low_[axis]), high_size = std::abs(high_[axis]);
            largest = std::max(largest, std::max(low_size, high_size));
            known &= low_size + high_size <= most;
        }
        set_error(sides, largest, known);
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
        _mm_store_ps(low_, low);
        _mm_store_ps(high_, high);
        const __m128 no_sign = _mm_castsi128_ps(_mm_set1_epi32(0x7fffffff));
        const __m128 low_size = _mm_and_ps(low, no_sign), high_size = _mm_and_ps(high, no_sign);
        const __m128 known = _mm_cmple_ps(_mm_add_ps(low_size, high_size), _mm_set1_ps(most));
        set_error(sides, largest_of_three(_mm_max_ps(low_size, high_size)), _mm_movemask_ps(known) == 15);
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
        const int apart = _mm_movemask_ps(_mm_cmpgt_ps(gap, error));
        const int not_deep = _mm_movemask_ps(_mm_cmpnlt_ps(gap, _mm_sub_ps(_mm_setzero_ps(), error)));
        return {apart, not_deep};
#else
        const float error = one.error_ + other.error_;
        int apart = 0, not_deep = 8;
        for (int axis = 0; axis < 3; ++axis)
        {
            const float gap = std::max(other.low_[axis] - one.high_[axis], one.low_[axis] - other.high_[axis]);
            apart |= (gap > error) << axis;
            not_deep |= !(gap < -error) << axis;
        }
        return {apart, not_deep};
#endif
    }

private:
    // @param known no side is, or is nearly, infinite or not a number: otherwise `largest` means nothing.
    template <typename Real> void set_error(const Real sides[6], float largest, bool known)
    {
        const bool exact = known || forgive_infinite_sides(sides, largest);
        error_ = exact ? unit * largest + least : std::numeric_limits<float>::infinity();
        minus_error_ = -error_;
    }

#if defined(__SSE2__)
    // The fourth is 0.
    static float largest_of_three(__m128 values)
    {
        const __m128 two = _mm_max_ps(values, _mm_movehl_ps(values, values));
        return _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps(two, two, 1)));
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
