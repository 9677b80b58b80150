// A line that is compared with many boxes: rays that ask the index.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_RAY_PROBE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_RAY_PROBE_H

#include <limits>

#include "ode_predictive_space/broadphase/base/float_box.h"

namespace ode_predictive_space
{
/// A straight line between two points, as a probe for EnvelopeTree::walk().
///
/// Box and line are apart when they are apart along one of six axes: those of the box, and those perpendicular to one of
/// them and to the line (separating axes: Gottschalk, Lin, Manocha 1996). Sums and differences of end points
/// and corners take the place of centres and half sizes, so all lengths are doubled. All is computed in single precision with a margin larger than its round-off, about 4e-6 of the
/// largest coordinate of the line and of the size of the box: a box that the line misses by less may count as met.
class RayProbe
{
public:
    /// Both finite; a line of no length is a point.
    ///
    /// @param miss by how much the line may miss a box and still meet it.
    RayProbe(const Vector3 &start, const Vector3 &end, double miss = 0)
        : centre_(nearest(start + end)), span_(nearest(end - start)), next_span_(span_.rotated()), reach_(abs(span_)),
          next_reach_(abs(next_span_)),
          margin_(Float4::all(rounding) * (abs(centre_) + reach_) + Float4::all(static_cast<float>(2 * miss)))
    {}

    /// Does the line meet the box? True when the box is infinite or not a number: nothing is known to be apart.
    bool overlaps(const FloatBox &box) const
    {
        // Both loads stay within the box.
        const Float4 low = Float4::load(box.low), high = Float4::load(box.low + 2).last_three();
        const Float4 offset = (high + low) - centre_;
        const Float4 extent = (high - low) * Float4::all(1 + rounding) + margin_;
        const Mask4 along_box = abs(offset) > extent + reach_;
        const Float4 distance = offset * next_span_ - offset.rotated() * span_;
        const Mask4 across = abs(distance) > extent * next_reach_ + extent.rotated() * reach_;
        constexpr unsigned three_lanes = 7;
        return ((along_box | across).bits() & three_lanes) == 0;
    }

private:
    // The coordinates of a box that the line meets are no larger than those of the line and the size of the box together.
    static constexpr float rounding = 8 * std::numeric_limits<float>::epsilon();
    static Float4 nearest(const Vector3 &vector) { return Float4::nearest(vector.data()); }

    Float4 centre_, span_; // of the line
    Float4 next_span_;     // rotated, as the next
    Float4 reach_;         // |span|
    Float4 next_reach_;
    Float4 margin_;
};
} // namespace ode_predictive_space

#endif
