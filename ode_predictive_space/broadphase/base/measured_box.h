// The bounding box of an object as it is now, for the test of near pairs.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_MEASURED_BOX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_MEASURED_BOX_H

#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/base/float_box.h"

namespace ode_predictive_space
{
/// What single precision can tell of two boxes.
class Comparison
{
public:
    /// @param apart a bit for each of three axes along which the boxes are apart.
    /// @param overlapping a bit for each axis along which it is certain that they overlap.
    Comparison(unsigned apart, unsigned overlapping) : bits_(8 * apart + overlapping) {}

    bool apart() const { return bits_ > three_lanes; }
    bool overlap() const { return bits_ == three_lanes; }
    /// The boxes are too close to tell, or one is not finite.
    bool unsure() const { return bits_ < three_lanes; }

private:
    unsigned bits_;
};

/// A box in single precision that knows its error: two such boxes are compared in a few instructions, and only those that
/// nearly touch have to be compared in double precision.
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
    void assign(const double sides[6])
    {
        const Float4 low = Float4::nearest_of_stored(sides, 2), high = Float4::nearest_of_stored(sides + 1, 2);
        const Float4 sizes = max(abs(low), abs(high));
        // A sum, so that NaN and infinity are found in one comparison.
        const bool known = (abs(low) + abs(high) <= Float4::all(most)).bits() == four_lanes;
        low.store_aligned(low_);
        high.store_aligned(high_);
        float largest = sizes.largest_of_three();
        const bool exact = known || without_infinite_sides(sides, largest);
        error_ = exact ? unit * largest + least : std::numeric_limits<float>::infinity();
        minus_error_ = -error_;
    }

    /// The same for a scene in single precision.
    void assign(const float sides[6])
    {
        const double exact[] = {sides[0], sides[1], sides[2], sides[3], sides[4], sides[5]};
        assign(exact);
    }

    /// A box that holds the measured one.
    FloatBox outer() const
    {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        // Differences of infinities would be NaN. A box that is not finite may be everywhere.
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

    /// Is the box within these sides, of which three lanes count? False, too, when that is too close to tell.
    bool inside(Float4 low, Float4 high) const
    {
        const Float4 error = Float4::all(error_);
        const Mask4 above = Float4::load_aligned(low_) - low >= error;
        const Mask4 below = high - Float4::load_aligned(high_) >= error;
        return ((above & below).bits() & three_lanes) == three_lanes;
    }

    /// Without a branch on the outcome, which would often be mispredicted.
    friend Comparison compare(const MeasuredBox &one, const MeasuredBox &other)
    {
        // In each of three lanes the larger of the gaps on both sides, in the fourth the sum of the errors, which is neither
        // larger than itself nor negative.
        const Float4 before = Float4::load_aligned(other.low_) - Float4::load_aligned(one.high_);
        const Float4 after = Float4::load_aligned(one.low_) - Float4::load_aligned(other.high_);
        const Float4 gap = max(before, after), error = gap.fourth_in_all();
        return {(gap > error).bits(), (gap < -error).bits()};
    }

private:
    // A side that lies at infinity is known well: there is no gap. (A side that overflowed single precision is not.)
    static bool without_infinite_sides(const double sides[6], float &largest)
    {
        constexpr double infinity = std::numeric_limits<double>::infinity();
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
