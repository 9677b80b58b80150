// A line that is compared with many boxes, for queries by ray.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_RAY_PROBE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_RAY_PROBE_H

#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/base/four_boxes.h"

namespace ode_predictive_space
{
/// A straight line between two points, as a probe for EnvelopeTree::walk(). Box and line are apart if they are apart along one
/// of six axes: those of the box, and those perpendicular to one of them and to the line (separating axes: Gottschalk, Lin,
/// Manocha 1996). Sums and differences of end points and corners replace centres and half sizes, so all lengths are doubled.
/// Single precision gets a margin larger than its round-off, about 4e-6 of the largest coordinate of the line and of the size
/// of the box: a box that the line misses by less may count as met.
class RayProbe
{
public:
    /// @pre the line is inside a bounded() box. It may have length 0.
    /// @param miss distance up to which a missed box counts as met.
    RayProbe(const Vector3 &start, const Vector3 &end, double miss = 0)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            const auto centre = static_cast<float>(start[axis] + end[axis]);
            const auto span = static_cast<float>(end[axis] - start[axis]);
            const float margin = rounding * (std::abs(centre) + std::abs(span)) + static_cast<float>(2 * miss);
            centre_[axis] = Float4::all(centre);
            span_[axis] = Float4::all(span);
            reach_[axis] = Float4::all(std::abs(span));
            margin_[axis] = Float4::all(margin);
        }
    }

    /// One bit per place, set if the line may meet its box. Infinite sides and NaN prove nothing apart.
    unsigned overlaps(const FourBoxes &boxes) const
    {
        // Boxes may be unbounded. Sides are clamped beyond all lines, which are bounded.
        const Float4 beyond = Float4::all(4e15f);
        Float4 offset[3], extent[3];
        for (int axis = 0; axis < 3; ++axis)
        {
            const Float4 low = min(max(boxes.lows(axis), -beyond), beyond);
            const Float4 high = max(min(boxes.highs(axis), beyond), -beyond);
            offset[axis] = (high + low) - centre_[axis];
            extent[axis] = (high - low) * Float4::all(1 + rounding) + margin_[axis];
        }
        const auto along = [&](int axis) { return abs(offset[axis]) > extent[axis] + reach_[axis]; };
        const auto across = [&](int one, int other) {
            const Float4 distance = offset[one] * span_[other] - offset[other] * span_[one];
            return abs(distance) > extent[one] * reach_[other] + extent[other] * reach_[one];
        };
        return four_lanes & ~(along(0) | along(1) | along(2) | across(0, 1) | across(1, 2) | across(2, 0)).bits();
    }

    bool overlaps(const FloatBox &box) const { return (overlaps(FourBoxes::all(box)) & 1) != 0; }

private:
    // Relative to line and box size; a box that the line meets has no larger coordinates than both together.
    static constexpr float rounding = 8 * std::numeric_limits<float>::epsilon();

    Float4 centre_[3], span_[3], margin_[3];
    Float4 reach_[3]; // |span|
};
} // namespace ode_predictive_space

#endif
