// Boxes in single precision, rounded outwards, for the index and the sweep.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_FLOAT_BOX_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_FLOAT_BOX_H

#include <algorithm>

#include "ode_predictive_space/broadphase/base/ids.h"
#include "ode_predictive_space/broadphase/base/rounding.h"
#include "ode_predictive_space/broadphase/base/simd.h"
#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// An axis-aligned box that holds the double-precision box it was made of. It is closed: touching boxes overlap.
struct FloatBox
{
    float low[3];
    float high[3];

    static FloatBox around(const Box &box)
    {
        const Float4 low = Float4::rounded_down(box.min().data(), 1);
        const Float4 minus_high = Float4::rounded_down(box.max().data(), -1);
        const Float4 most = Float4::all(std::numeric_limits<float>::max());
        if (((max(abs(low), abs(minus_high)) <= most) & (abs(low) <= most)).bits() == four_lanes)
            return of(low, -minus_high);
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

    bool operator==(const FloatBox &other) const
    {
        return std::equal(low, low + 3, other.low) && std::equal(high, high + 3, other.high);
    }

    FloatBox merged(const FloatBox &other) const { return of(merged_lows(other), merged_highs(other).last_three()); }

    float doubled_centre(int axis) const { return low[axis] + high[axis]; }
    /// doubled_centre() of all axes in the first three lanes; the fourth is undefined.
    Float4 doubled_centres() const { return Float4::load(low) + Float4::load(low + 2).last_three(); }

    /// Half the surface area: the cost measure of a tree.
    float half_area() const
    {
        const Float4 sides = Float4::load(low + 2).last_three() - Float4::load(low);
        return (sides * sides.rotated()).sum_of_three();
    }

    /// False when a side is infinite, NaN, or so far away that areas overflow. A tree must not hold such a box.
    bool bounded() const
    {
        const Float4 limit = Float4::all(1e15f);
        return ((abs(Float4::load(low)) < limit) & (abs(Float4::load(low + 2)) < limit)).bits() == four_lanes;
    }

private:
    static FloatBox of(Float4 low, Float4 high)
    {
        FloatBox box;
        low.store(box.low); // its fourth lane is overwritten by the next store
        high.store_three(box.high);
        return box;
    }

    // The loads overlap by two components, so that neither leaves the box: low x, y, z, high x; and low z, high x, y, z.
    Float4 merged_lows(const FloatBox &other) const { return min(Float4::load(low), Float4::load(other.low)); }
    Float4 merged_highs(const FloatBox &other) const { return max(Float4::load(low + 2), Float4::load(other.low + 2)); }
};
static_assert(sizeof(FloatBox) == 6 * sizeof(float), "low and high are read as one array");

struct SweptProxy
{
    ProxyId proxy;
    FloatBox box;
};
} // namespace ode_predictive_space

#endif
