#include "ode_predictive_space/prediction/proximity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_predictive_space
{
namespace
{
// Six linear functions over [0, 1], one for each side of a box: where are all of them <= 0? Without a branch for each, as
// those would be mispredicted.
struct LinearGaps
{
    double begin[6];
    double end[6];

    // False as soon as one is not a number.
    bool known() const
    {
        bool known = true;
        for (int side = 0; side < 6; ++side)
            known &= !(std::isnan(begin[side]) | std::isnan(end[side]));
        return known;
    }

    // Is one of them positive throughout? Most pairs that are looked at stay apart along some axis.
    bool stay_apart() const
    {
        int apart = 0;
        for (int side = 0; side < 6; ++side)
            apart |= static_cast<int>(begin[side] > 0) & static_cast<int>(end[side] > 0);
        return apart != 0;
    }

    // An infinite function has the same sign at both ends: what would be NaN is not chosen.
    ProximityInterval overlap() const
    {
        ProximityInterval all = {0, 1};
        for (int side = 0; side < 6; ++side)
        {
            const double from = begin[side], to = end[side], crossing = from / (from - to);
            const double enter = from > 0 ? (to > 0 ? 2 : crossing) : 0;
            const double leave = to > 0 ? (from > 0 ? -1 : crossing) : 1;
            all.enter = enter > all.enter ? enter : all.enter;
            all.leave = leave < all.leave ? leave : all.leave;
        }
        return all;
    }
};

// Lowers P(m), for all m >= 0, by more than rounding can have raised it or can raise its discriminant. Without that, paths
// that only just graze each other could be taken for apart.
ProximityPolynomial lowered_by_rounding(const ProximityPolynomial &P, double A_terms, double B_terms, double C_terms)
{
    return {P.A - rounding_per_size * A_terms, P.B - rounding_per_size * B_terms, P.C - rounding_per_size * C_terms};
}
} // namespace

std::optional<double> first_root(double A, double B, double C)
{
    if (!(C > 0))
        return 0.0;
    if (A >= 0 && B >= 0)
        return std::nullopt;
    const double D = B * B - A * C;
    if (D < 0)
        return std::nullopt;
    const double m = B > 0 ? (B + std::sqrt(D)) / -A : C / (std::sqrt(D) - B);
    return m >= 0 ? m : 0.0;
}

ProximityPolynomial proximity_polynomial(const Envelope &first, const Envelope &second, double duration, double error)
{
    const Path path = relative_path(first.path, second.path);
    const Vector3 chord = duration * (path.velocity + (0.5 * duration) * path.acceleration);
    const Deviation deviation = first.deviation + second.deviation;
    const double reach = deviation.a + first.radius + second.radius + error;
    const double growth = deviation.growth(duration);
    const ProximityPolynomial P = {chord.squaredNorm() - growth * growth, path.position.dot(chord) - reach * growth,
                                   path.position.squaredNorm() - reach * reach};
    return lowered_by_rounding(P, chord.squaredNorm() + growth * growth,
                               path.position.cwiseAbs().dot(chord.cwiseAbs()) + reach * growth,
                               path.position.squaredNorm() + reach * reach);
}

double sphere_chord_error(const Envelope &first, const Envelope &second, double duration)
{
    return chord_error(second.path.acceleration - first.path.acceleration, duration);
}

std::optional<double> sphere_time_of_proximity(const Envelope &first, const Envelope &second, double duration)
{
    if (!std::isfinite(first.radius) || !std::isfinite(second.radius))
        return 0.0;
    const Vector3 terms = size_of_terms(first.path, duration) + size_of_terms(second.path, duration);
    const double error = sphere_chord_error(first, second, duration) + rounding_per_size * terms.sum();
    const ProximityPolynomial P = proximity_polynomial(first, second, duration, error);
    const std::optional<double> m = first_root(P.A, P.B, P.C);
    if (!m || *m > 1 + rounding_per_size)
        return std::nullopt;
    return std::min(*m * (1 - rounding_per_size), 1.0) * duration;
}

std::optional<ProximityInterval> box_proximity(const Envelope &first, const Envelope &second, double duration)
{
    const Path path = relative_path(first.path, second.path);
    const Vector3 end = path.at(duration);
    const Deviation deviation = first.deviation + second.deviation;
    const double reach = deviation.a;
    const double reach_at_end = deviation.at(duration);
    const Vector3 terms = size_of_terms(first.path, duration) + size_of_terms(second.path, duration);
    const double eighth = 0.125 * duration * duration;
    LinearGaps gaps;
    for (int axis = 0; axis < 3; ++axis)
    {
        // On each side the gap is of second degree, and apart means that it is positive. Where its chord lies above it,
        // lower the chord; where the gap is concave, it lies above its chord anyway.
        const double bend_above = std::max(0.0, path.acceleration[axis] - 2 * deviation.c);
        const double bend_below = std::max(0.0, -path.acceleration[axis] - 2 * deviation.c);
        const double size_above = std::abs(second.low[axis]) + std::abs(first.high[axis]);
        const double size_below = std::abs(first.low[axis]) + std::abs(second.high[axis]);
        const double size = terms[axis] + reach_at_end;
        const double above =
            second.low[axis] - first.high[axis] - eighth * bend_above - rounding_per_size * (size + size_above);
        const double below =
            first.low[axis] - second.high[axis] - eighth * bend_below - rounding_per_size * (size + size_below);
        gaps.begin[axis] = above + path.position[axis] - reach;
        gaps.end[axis] = above + end[axis] - reach_at_end;
        gaps.begin[3 + axis] = below - path.position[axis] - reach;
        gaps.end[3 + axis] = below - end[axis] - reach_at_end;
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!gaps.known())
        return ProximityInterval{0, infinity};
    if (gaps.stay_apart())
        return std::nullopt;
    const ProximityInterval overlap = gaps.overlap();
    if (overlap.enter > overlap.leave + rounding_per_size)
        return std::nullopt;
    const double leave = overlap.leave * (1 + rounding_per_size) + rounding_per_size;
    return ProximityInterval{overlap.enter * (1 - rounding_per_size) * duration,
                             leave < 1 ? leave * duration : infinity};
}
} // namespace ode_predictive_space
