#include "ode_predictive_space/broadphase/approach.h"

#include <algorithm>

namespace ode_predictive_space
{
namespace
{
using Axes = Eigen::Array4f;

constexpr float infinity = std::numeric_limits<float>::infinity();

// What is computed here may be off by this part of the sum of all terms: by rounding here, in the check of a position
// against its path, and in the path itself.
constexpr float rounding_unit = 16 * std::numeric_limits<float>::epsilon();

// A time may be off by this part of the horizon, beyond what the gaps are off.
constexpr float time_margin = 8 * std::numeric_limits<float>::epsilon();

// See ProxyStore::rounded_by_scene().
constexpr bool scene_rounds = sizeof(SceneReal) < sizeof(double);
constexpr float scene_unit = 8 * std::numeric_limits<float>::epsilon();

// Reads the float that is behind the three.
Axes axes(const float *three)
{
    return Eigen::Map<const Axes>(three);
}

Axes axes(const Vector3 &vector, float fourth)
{
    return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z()), fourth};
}

// Of two positions, with something else behind it. Without a detour through memory, for which the processor would have to
// wait.
Axes difference(const double *left, const double *right, float fourth)
{
#if defined(__SSE2__)
    const __m128d xy = _mm_sub_pd(_mm_loadu_pd(left), _mm_loadu_pd(right));
    const __m128d z = _mm_sub_sd(_mm_load_sd(left + 2), _mm_load_sd(right + 2));
    Axes result;
    const __m128 z_and_fourth = _mm_unpacklo_ps(_mm_cvtpd_ps(z), _mm_set_ss(fourth));
    _mm_store_ps(result.data(), _mm_movelh_ps(_mm_cvtpd_ps(xy), z_and_fourth));
    return result;
#else
    return axes(Vector3(left[0] - right[0], left[1] - right[1], left[2] - right[2]), fourth);
#endif
}

// Is one of the first three positive?
bool one_is_positive(const Axes &values)
{
#if defined(__SSE2__)
    return (_mm_movemask_ps(_mm_cmpgt_ps(_mm_load_ps(values.data()), _mm_setzero_ps())) & 7) != 0;
#else
    return (values[0] > 0) | (values[1] > 0) | (values[2] > 0);
#endif
}

// Are the first three below infinity, and numbers?
bool all_are_below_infinity(const Axes &values)
{
#if defined(__SSE2__)
    return (_mm_movemask_ps(_mm_cmplt_ps(_mm_load_ps(values.data()), _mm_set1_ps(infinity))) & 7) == 7;
#else
    return (values[0] < infinity) & (values[1] < infinity) & (values[2] < infinity);
#endif
}

float largest_of_three(const Axes &values)
{
    return std::max(values[0], std::max(values[1], values[2]));
}

float smallest_of_three(const Axes &values)
{
    return std::min(values[0], std::min(values[1], values[2]));
}

// Where a linear function over [0, 1] falls to 0: at 0 when it is never above it. (When it stays above, who asks has found
// the boxes apart.)
Axes first_not_above(const Axes &begin, const Axes &end)
{
    const Axes above = begin.max(0);
    return above / (above + (-end).max(0) + std::numeric_limits<float>::min());
}

// Where it rises above 0: at 1 when it does not. The infinite ones are below it throughout.
Axes last_not_above(const Axes &begin, const Axes &end)
{
    constexpr float most = 1e30f;
    const Axes below = (-begin).max(0).min(most) + std::numeric_limits<float>::min();
    return below / (below + end.max(0));
}

float radius_or_zero(float radius)
{
    return radius < infinity ? radius : 0;
}
} // namespace

// Between the boxes on each of six sides, at the beginning and the end of the horizon, never too large: apart means that
// one is positive.
struct Approach::Gaps
{
    Axes above_begin, above_end, below_begin, below_end;

    // False as soon as one is not a number.
    bool known() const { return all_are_below_infinity(above_begin + above_end + below_begin + below_end); }

    bool stay_apart() const { return one_is_positive(above_begin.min(above_end).max(below_begin.min(below_end))); }

    float enter() const
    {
        return largest_of_three(first_not_above(above_begin, above_end).max(first_not_above(below_begin, below_end)));
    }

    float leave() const
    {
        return smallest_of_three(last_not_above(above_begin, above_end).min(last_not_above(below_begin, below_end)));
    }
};

Approach::Approach(const ProxyStore &proxies, ProxyId id, Tick now)
    : proxies_(proxies), id_(id), now_(now), age_(age(id))
{
    const PackedPath &path = proxies.paths[id];
    const PackedBounds &bounds = proxies.bounds[id];
    const Path since = path.path(), current = since.advanced(age_);
    position_ = current.position;
    reach_ = path.reach(age_);
    velocity_ = axes(current.velocity, -(path.deviation_rate + 2 * age_ * path.deviation_bend));
    half_acceleration_ = axes(0.5 * since.acceleration, -path.deviation_bend);
    speed_ = axes(path.velocity).abs();
    bend_ = 2 * axes(path.half_acceleration).abs();
    const Axes low = axes(bounds.low), high = axes(bounds.high);
    low_ = low - rounding_unit * low.abs();
    high_ = high + rounding_unit * high.abs();
    // Four times: the other's position is hardly farther away from the origin.
    double_rounding_ = axes(Vector3(4 * rounding_per_size * size_of_terms(since, age_)), 0);
    scene_rounding_ = static_cast<float>(2 * position_.lpNorm<Eigen::Infinity>()) + radius_or_zero(bounds.radius);
}

float Approach::age(ProxyId id) const
{
    return proxies_.bounds[id].still ? 0 : static_cast<float>(ticks_between(proxies_.paths[id].since, now_));
}

Axes Approach::rounding(ProxyId other, const Axes &offset, const Axes &terms) const
{
    Axes sum = rounding_unit * terms + double_rounding_;
    if constexpr (!scene_rounds)
        return sum;
    const float radius = radius_or_zero(proxies_.bounds[other].radius);
    return sum + scene_unit * (scene_rounding_ + largest_of_three(offset.abs()) + radius);
}

// Each gap is of second degree. Where its chord lies above it, the chord is lowered; where it is concave, it lies above its
// chord anyway.
//
// The deviations of both together are computed as a fourth axis along which the two move away from each other.
inline Approach::Gaps Approach::gaps(ProxyId other, float duration) const
{
    const PackedPath &path = proxies_.paths[other];
    const PackedBounds &bounds = proxies_.bounds[other];
    const float age = this->age(other);
    const Axes velocity = axes(path.velocity), half_acceleration = axes(path.half_acceleration);
    const Axes offset = difference(path.position, position_.data(), reach_ + path.deviation_base);
    const Axes half_bend = half_acceleration - half_acceleration_;
    const Axes begin = offset + age * (velocity + age * half_acceleration);
    const Axes end = begin + duration * (velocity + (2 * age) * half_acceleration - velocity_ + duration * half_bend);
    const float reach = begin[3], reach_at_end = end[3], half_reach_bend = half_bend[3];

    const float until = age + duration, own_until = age_ + duration;
    const Axes terms = offset.abs() + until * (velocity.abs() + (2 * until) * half_acceleration.abs()) +
                       own_until * (speed_ + own_until * bend_) + reach_at_end;
    const Axes rounding = this->rounding(other, offset, terms);
    const Axes low = axes(bounds.low), high = axes(bounds.high);
    const float quarter = 0.25f * duration * duration;
    const Axes above =
        low - rounding_unit * low.abs() - high_ - rounding - quarter * (half_bend - half_reach_bend).max(0);
    const Axes below =
        low_ - high - rounding_unit * high.abs() - rounding - quarter * (-half_bend - half_reach_bend).max(0);
    return {above + begin - reach, above + end - reach_at_end, below - begin - reach, below - end - reach_at_end};
}

std::optional<ProximityInterval> Approach::to(ProxyId other) const
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
} // namespace ode_predictive_space
