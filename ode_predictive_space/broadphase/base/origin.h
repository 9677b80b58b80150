// The origin of coordinates in single precision: a point near the objects.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_ORIGIN_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_ORIGIN_H

#include <algorithm>
#include <limits>

#include "ode_predictive_space/broadphase/base/rounding.h"
#include "ode_predictive_space/broadphase/base/simd.h"
#include "ode_predictive_space/prediction/envelope.h"

namespace ode_predictive_space
{
/// A point in the program's coordinates. Differences to it are computed in double precision.
class Origin
{
public:
    Origin() : Origin(Vector3::Zero()) {}
    /// @param place finite.
    explicit Origin(const Vector3 &place)
    {
        const Vector3 lost = 4 * std::numeric_limits<double>::epsilon() * place.cwiseAbs();
        float doubt[3];
        for (int axis = 0; axis < 3; ++axis)
        {
            place_[axis] = place[axis];
            doubt[axis] = std::max(least_doubt, round_up(lost[axis]));
        }
        doubt_ = Float4(doubt[0], doubt[1], doubt[2], 0);
        for_least_ = place + lost;
        for_greatest_ = place - lost;
    }

    Vector3 place() const { return Vector3(place_[0], place_[1], place_[2]); }

    /// Upper bound, greater than 0, of the rounding error that this origin adds to the program's coordinates.
    Float4 doubt() const { return doubt_; }

    /// The point relative to this origin; fast for coordinates that were just stored, see Float4::nearest_of_stored().
    Float4 nearest_of_stored(const double *point) const { return Float4::difference_of_stored(point, place_); }
    /// In single precision the origin is always the program's.
    Float4 nearest_of_stored(const float *point) const { return Float4::nearest_of_stored(point, 1); }

    /// A box relative to this origin that holds the given one.
    Box around(const Box &box) const { return Box(box.min() - for_least_, box.max() - for_greatest_); }

private:
    static constexpr float least_doubt = 8 * std::numeric_limits<float>::min();

    alignas(16) double place_[4] = {};
    Float4 doubt_;
    Vector3 for_least_, for_greatest_; // subtrahends for the low and high sides of boxes
};
} // namespace ode_predictive_space

#endif
