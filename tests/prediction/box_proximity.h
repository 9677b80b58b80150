// When the boxes of two envelopes may overlap, in double precision and written plainly: the oracle of PairProximity, and
// itself compared with the true first contact in never_late_test.cpp.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_PREDICTION_BOX_PROXIMITY_H
#define ODE_PREDICTIVE_SPACE_TESTS_PREDICTION_BOX_PROXIMITY_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "ode_predictive_space/prediction/proximity.h"

namespace ode_predictive_space
{
/// The distance between two boxes on one side at the ends of the horizon, never too large; linear in between.
struct LinearGap
{
    double begin;
    double end;
};

/// On each side the gap is of second degree, and apart means that it is positive. Where its chord lies above it, the chord is
/// lowered; where the gap is concave, it lies above its chord anyway.
inline std::array<LinearGap, 6> lowered_gaps(const Envelope &first, const Envelope &second, double duration)
{
    const Path path = relative_path(first.path, second.path);
    const Vector3 end = path.at(duration);
    const Deviation deviation = first.deviation + second.deviation;
    const double reach = deviation.a;
    const double reach_at_end = deviation.at(duration);
    const Vector3 terms = size_of_terms(first.path, duration) + size_of_terms(second.path, duration);
    const double eighth = 0.125 * duration * duration;
    std::array<LinearGap, 6> gaps;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double bend_above = std::max(0.0, path.acceleration[axis] - 2 * deviation.c);
        const double bend_below = std::max(0.0, -path.acceleration[axis] - 2 * deviation.c);
        const double size_above = std::abs(second.low[axis]) + std::abs(first.high[axis]);
        const double size_below = std::abs(first.low[axis]) + std::abs(second.high[axis]);
        const double size = terms[axis] + reach_at_end;
        const double above =
            second.low[axis] - first.high[axis] - eighth * bend_above - rounding_per_size * (size + size_above);
        const double below =
            first.low[axis] - second.high[axis] - eighth * bend_below - rounding_per_size * (size + size_below);
        gaps[axis] = {above + path.position[axis] - reach, above + end[axis] - reach_at_end};
        gaps[3 + axis] = {below - path.position[axis] - reach, below - end[axis] - reach_at_end};
    }
    return gaps;
}

/// When the axis-aligned boxes of both envelopes may overlap within [0, duration]: the latest of the entries into the three
/// slabs |distance along the axis| <= half extents + R(t), if all three overlap at that time, and the earliest of the exits.
/// Infinite bounds are never apart on their side. Never late to enter and never early to leave, with respect to
/// Envelope::at() as computed, rounding included.
inline std::optional<ProximityInterval> box_proximity(const Envelope &first, const Envelope &second, double duration)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::array<LinearGap, 6> gaps = lowered_gaps(first, second, duration);
    for (const LinearGap &gap : gaps)
        if (std::isnan(gap.begin) || std::isnan(gap.end))
            return ProximityInterval{0, infinity};
    double enter = 0, leave = 1;
    for (const LinearGap &gap : gaps)
    {
        const double crossing = gap.begin / (gap.begin - gap.end);
        if (gap.begin > 0 && gap.end > 0)
            return std::nullopt;
        if (gap.begin > 0)
            enter = std::max(enter, crossing);
        else if (gap.end > 0)
            leave = std::min(leave, crossing);
    }
    if (enter > leave + rounding_per_size)
        return std::nullopt;
    leave = leave * (1 + rounding_per_size) + rounding_per_size;
    return ProximityInterval{enter * (1 - rounding_per_size) * duration, leave < 1 ? leave * duration : infinity};
}

/// Its beginning.
inline std::optional<double> box_time_of_proximity(const Envelope &first, const Envelope &second, double duration)
{
    const std::optional<ProximityInterval> interval = box_proximity(first, second, duration);
    return interval ? std::optional<double>(interval->enter) : std::nullopt;
}
} // namespace ode_predictive_space

#endif
