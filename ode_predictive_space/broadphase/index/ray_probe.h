// A line that is compared with many boxes: rays that ask the index.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_RAY_PROBE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_RAY_PROBE_H

#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/base/float_box.h"

namespace ode_predictive_space
{
/// A straight line between two points, as a probe for EnvelopeTree::walk().
///
/// Box and line are apart when they are apart along one of six axes: those of the box, and those perpendicular to one of
/// them and to the line (separating axes: Gottschalk, Lin, Manocha 1996). All is computed in single precision with a margin
/// larger than its round-off, about 4e-6 of the largest coordinate: a box that the line misses by less may count as met.
class RayProbe
{
public:
    /// Both finite; a line of no length is a point.
    ///
    /// @param miss by how much the line may miss a box and still meet it.
    RayProbe(const Vector3 &start, const Vector3 &end, double miss = 0)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            centre_[axis] = static_cast<float>(0.5 * (start[axis] + end[axis]));
            half_[axis] = static_cast<float>(0.5 * (end[axis] - start[axis]));
            reach_[axis] = std::abs(half_[axis]);
            margin_[axis] = rounding * (std::abs(centre_[axis]) + reach_[axis]) + static_cast<float>(miss);
        }
    }

    /// Does the line meet the box? True when the box is infinite or not a number: nothing is known to be apart.
    bool overlaps(const FloatBox &box) const
    {
        float offset[3], extent[3];
        bool apart = false;
        for (int axis = 0; axis < 3; ++axis)
        {
            const float low = box.low[axis], high = box.high[axis];
            offset[axis] = 0.5f * (high + low) - centre_[axis];
            extent[axis] = 0.5f * (high - low) + rounding * (std::abs(high) + std::abs(low)) + margin_[axis];
            apart |= std::abs(offset[axis]) > extent[axis] + reach_[axis];
        }
        for (int axis = 0; axis < 3; ++axis)
        {
            const int next = axis == 2 ? 0 : axis + 1;
            const float distance = offset[axis] * half_[next] - offset[next] * half_[axis];
            apart |= std::abs(distance) > extent[axis] * reach_[next] + extent[next] * reach_[axis];
        }
        return !apart;
    }

private:
    static constexpr float rounding = 8 * std::numeric_limits<float>::epsilon();

    float centre_[3], half_[3]; // of the line
    float reach_[3];            // |half|
    float margin_[3];
};
} // namespace ode_predictive_space

#endif
