#include "ode_predictive_space/broadphase/schedule/pair_proximity.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space
{
namespace
{
constexpr float float_infinity = std::numeric_limits<float>::infinity();

// What is computed here may be off by this part of the sum of all terms: by rounding here, in the check of a position
// against its path, and in the path itself.
constexpr float rounding_unit = 16 * std::numeric_limits<float>::epsilon();

// A time may be off by this part of the horizon, beyond the error of the gaps.
constexpr float time_margin = 8 * std::numeric_limits<float>::epsilon();

// Where a linear function over [0, 1] falls to 0: at 0 when it is never above it. (When it stays above, the boxes are apart.)
Float4 first_not_above(Float4 begin, Float4 end)
{
    const Float4 above = max(begin, Float4::all(0));
    return above / (above + max(-end, Float4::all(0)) + Float4::all(std::numeric_limits<float>::min()));
}

// Where it rises above 0: at 1 when it does not. Infinite functions are below it throughout.
Float4 last_not_above(Float4 begin, Float4 end)
{
    constexpr float most = 1e30f;
    const Float4 below =
        min(max(-begin, Float4::all(0)), Float4::all(most)) + Float4::all(std::numeric_limits<float>::min());
    return below / (below + max(end, Float4::all(0)));
}

float finite_or_zero(float radius)
{
    return radius < float_infinity ? radius : 0;
}

// Verification keeps each coordinate within the deviation; a sphere needs the distance.
Envelope spherical(Envelope envelope)
{
    constexpr double root_of_3 = 1.7320508075688774;
    envelope.deviation = root_of_3 * envelope.deviation;
    return envelope;
}
} // namespace

// The gaps between the boxes on each of six sides, at the beginning and the end of the horizon, never too large. The boxes are
// apart when one is positive.
struct PairProximity::Gaps
{
    Float4 above_begin, above_end, below_begin, below_end;

    // False as soon as one is not a number.
    bool known() const
    {
        const Float4 sum = above_begin + above_end + below_begin + below_end;
        return ((sum < Float4::all(float_infinity)).bits() & three_lanes) == three_lanes;
    }

    bool stay_apart() const
    {
        const Float4 least = max(min(above_begin, above_end), min(below_begin, below_end));
        return ((least > Float4::all(0)).bits() & three_lanes) != 0;
    }

    float enter() const
    {
        return max(first_not_above(above_begin, above_end), first_not_above(below_begin, below_end)).largest_of_three();
    }

    float leave() const
    {
        return min(last_not_above(above_begin, above_end), last_not_above(below_begin, below_end)).smallest_of_three();
    }
};

PairProximity::PairProximity(const ProxyStore &proxies, ProxyId id, Tick now, ProximityTest test)
    : proxies_(proxies), id_(id), now_(now), test_(test), age_(age(id)),
      scene_rounding_(static_cast<float>(proxies.scene_rounding()))
{
    const PackedPath &path = proxies.paths[id];
    const ProxyRecord::Prediction &bounds = proxies.records[id].prediction;
    const Path since = path.path(), current = since.advanced(age_);
    std::copy_n(current.position.data(), 3, position_);
    reach_ = path.reach(age_);
    velocity_ =
        Float4::nearest(current.velocity.data()).with_fourth(-(path.deviation_rate + 2 * age_ * path.deviation_bend));
    half_acceleration_ = Float4::load_aligned(path.half_acceleration).with_fourth(-path.deviation_bend);
    speed_ = abs(Float4::load_aligned(path.velocity));
    bend_ = Float4::all(2) * abs(Float4::load_aligned(path.half_acceleration));
    const Float4 low = Float4::load(bounds.low), high = Float4::load(bounds.high);
    low_ = low - Float4::all(rounding_unit) * abs(low);
    high_ = high + Float4::all(rounding_unit) * abs(high);
    // Four times: the other's position is hardly farther away from the origin.
    const Vector3 double_rounding = 4 * rounding_per_size * size_of_terms(since, age_);
    double_rounding_ = Float4::nearest(double_rounding.data());
}

float PairProximity::age(ProxyId id) const
{
    return proxies_.records[id].kind.still ? 0 : static_cast<float>(ticks_between(proxies_.paths[id].since, now_));
}

Float4 PairProximity::rounding(ProxyId other, Float4 offset, Float4 terms) const
{
    const Float4 sum = Float4::all(rounding_unit) * terms + double_rounding_;
    if (scene_rounding_ == 0)
        return sum;
    const double farthest = std::max({std::abs(position_[0]), std::abs(position_[1]), std::abs(position_[2])});
    const float radii = finite_or_zero(proxies_.records[id_].prediction.radius) +
                        finite_or_zero(proxies_.records[other].prediction.radius);
    return sum +
           Float4::all(scene_rounding_ * (static_cast<float>(2 * farthest) + abs(offset).largest_of_three() + radii));
}

// Each gap is of second degree. Where its chord lies above it, the chord is lowered; where it is concave, it lies above its
// chord anyway. The deviations of both together are a fourth axis along which the two move away from each other.
inline PairProximity::Gaps PairProximity::gaps(ProxyId other, float duration) const
{
    const PackedPath &path = proxies_.paths[other];
    const ProxyRecord::Prediction &bounds = proxies_.records[other].prediction;
    const float age = this->age(other);
    const Float4 ages = Float4::all(age), durations = Float4::all(duration);
    const Float4 velocity = Float4::load_aligned(path.velocity);
    const Float4 half_acceleration = Float4::load_aligned(path.half_acceleration);
    const Float4 offset = Float4::difference(path.position, position_).with_fourth(reach_ + path.deviation_base);
    const Float4 half_bend = half_acceleration - half_acceleration_;
    const Float4 begin = offset + ages * (velocity + ages * half_acceleration);
    const Float4 end =
        begin + durations * (velocity + Float4::all(2 * age) * half_acceleration - velocity_ + durations * half_bend);
    const Float4 reach = begin.fourth_in_all(), reach_at_end = end.fourth_in_all();
    const Float4 half_reach_bend = half_bend.fourth_in_all();

    const Float4 until = Float4::all(age + duration), own_until = Float4::all(age_ + duration);
    const Float4 terms = abs(offset) + until * (abs(velocity) + (until + until) * abs(half_acceleration)) +
                         own_until * (speed_ + own_until * bend_) + reach_at_end;
    const Float4 rounding = this->rounding(other, offset, terms);
    const Float4 low = Float4::load(bounds.low), high = Float4::load(bounds.high), unit = Float4::all(rounding_unit);
    const Float4 quarter = Float4::all(0.25f * duration * duration), none = Float4::all(0);
    const Float4 above = low - unit * abs(low) - high_ - rounding - quarter * max(half_bend - half_reach_bend, none);
    const Float4 below = low_ - high - unit * abs(high) - rounding - quarter * max(-half_bend - half_reach_bend, none);
    return {above + begin - reach, above + end - reach_at_end, below - begin - reach, below - end - reach_at_end};
}

std::optional<ProximityInterval> PairProximity::of_boxes(ProxyId other) const
{
    constexpr double never = std::numeric_limits<double>::infinity();
    const auto duration = static_cast<float>(proxies_.common_horizon(id_, other, now_));
    const Gaps gaps = this->gaps(other, duration);
    if (!gaps.known())
        return ProximityInterval{0, never};
    if (gaps.stay_apart())
        return std::nullopt;
    const float enter = gaps.enter(), leave = gaps.leave();
    if (enter > leave + time_margin)
        return std::nullopt;
    const float left = leave * (1 + time_margin) + time_margin;
    return ProximityInterval{enter * (1 - time_margin) * duration, left < 1 ? left * duration : never};
}

// An object that is checked by its centre keeps its sphere. The sphere around a bounding box may stick out of the one around the
// envelope that holds the box.
bool PairProximity::keeps_sphere(ProxyId id) const
{
    return proxies_.records[id].kind.check == Check::centre;
}

// Boxes and spheres must be near: not before the later of the two first times.
std::optional<ProximityInterval> PairProximity::of_spheres(ProxyId other, const ProximityInterval &of_boxes) const
{
    if (!keeps_sphere(id_) || !keeps_sphere(other))
        return of_boxes;
    const std::optional<double> time = sphere_time_of_proximity(spherical(proxies_.outer_envelope(id_, now_)),
                                                                spherical(proxies_.outer_envelope(other, now_)),
                                                                proxies_.common_horizon(id_, other, now_));
    if (!time)
        return std::nullopt;
    return ProximityInterval{std::max(of_boxes.enter, *time), of_boxes.leave};
}

std::optional<ProximityInterval> PairProximity::to(ProxyId other) const
{
    const std::optional<ProximityInterval> boxes = of_boxes(other);
    return boxes && test_ == ProximityTest::sphere ? of_spheres(other, *boxes) : boxes;
}
} // namespace ode_predictive_space
