// Is an object inside its envelope? In: its prediction, and where it is. Out: yes or no; "no" is always safe.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_VERIFY_CHECKS_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_VERIFY_CHECKS_H

#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/base/measured_box.h"
#include "ode_predictive_space/broadphase/objects/proxy_store.h"

namespace ode_predictive_space
{
/// How far the path has come along each axis after t and, in the fourth lane, how much the deviation has grown.
inline Float4 moved_and_grown(const PackedPath &path, float t)
{
    const Float4 times = Float4::all(t);
    return times * (Float4::load_aligned(path.velocity) + times * Float4::load_aligned(path.half_acceleration));
}

/// R(t) in each lane.
inline Float4 reach_on_all_axes(const PackedPath &path, Float4 moved_and_grown)
{
    return Float4::all(path.deviation_base) + moved_and_grown.fourth_in_all();
}

/// |x - s(t)| <= R(t) along each axis. False when anything is NaN.
///
/// The distance that the centre has come is taken in double precision, all else in single; what that may add or hide is
/// allowed for in ProxyStore::outer_envelope(). A still envelope has a path and a deviation that are constant.
inline bool centre_inside(const PackedPath &path, const double *centre, Tick now)
{
    const Float4 moved = moved_and_grown(path, static_cast<float>(ticks_between(path.since, now)));
    const Float4 off = abs(Float4::difference(centre, path.position) - moved);
    // In the fourth lane, the growth of the deviation is no more than all of it.
    return (off <= reach_on_all_axes(path, moved)).bits() == four_lanes;
}

/// The same for a scene in single precision.
inline bool centre_inside(const PackedPath &path, const float *centre, Tick now)
{
    const double exact[] = {centre[0], centre[1], centre[2]};
    return centre_inside(path, exact, now);
}

/// Is the box within the envelope at its time 0? A side of the box may be NaN only where the envelope is infinite.
inline bool bounds_inside(const Envelope &envelope_now, const Box &box)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Box allowed = envelope_now.at(0);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
    {
        inside &= allowed.min()[axis] <= box.min()[axis] || allowed.min()[axis] == -infinity;
        inside &= box.max()[axis] <= allowed.max()[axis] || allowed.max()[axis] == infinity;
    }
    return inside;
}

/// The same for a packed envelope at the tick `now`, evaluated as centre_inside() does it.
inline bool bounds_inside(const PackedPath &path, const ProxyRecord &record, const Box &box, Tick now)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float t = record.kind.still ? 0 : static_cast<float>(ticks_between(path.since, now));
    const float *low = record.prediction.low, *high = record.prediction.high;
    const double reach = path.reach(t);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double centre = path.position[axis] + t * (path.velocity[axis] + t * path.half_acceleration[axis]);
        inside &= (centre + low[axis] - reach <= box.min()[axis]) | (low[axis] == -infinity);
        inside &= (box.max()[axis] <= centre + high[axis] + reach) | (high[axis] == infinity);
    }
    return inside;
}

/// The same in single precision: false, too, when that is too close to tell.
inline bool surely_inside(const PackedPath &path, const ProxyRecord &record, const MeasuredBox &box, Tick now)
{
    const float t = record.kind.still ? 0 : static_cast<float>(ticks_between(path.since, now));
    const Float4 moved = moved_and_grown(path, t), reach = reach_on_all_axes(path, moved);
    const Float4 position = Float4::nearest(path.position), centre = position + moved;
    const Float4 low = centre + Float4::load(record.prediction.low) - reach;
    const Float4 high = centre + Float4::load(record.prediction.high) + reach;
    const Float4 terms = (abs(position) + abs(moved)) + (abs(low) + abs(high));
    const Float4 rounding = terms * Float4::all(4 * std::numeric_limits<float>::epsilon());
    return box.inside(low + rounding, high - rounding) && !record.placement.unbounded;
}
} // namespace ode_predictive_space

#endif
