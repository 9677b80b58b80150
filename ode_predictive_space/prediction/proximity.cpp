#include "ode_predictive_space/prediction/proximity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_predictive_space
{
namespace
{
// Lowers P(m), m >= 0, by more than rounding raises P or its discriminant: paths that barely touch must not be found apart.
ProximityPolynomial lowered_by_rounding(const ProximityPolynomial &P, double A_terms, double B_terms, double C_terms)
{
    return {P.A - rounding_per_size * A_terms, P.B - rounding_per_size * B_terms, P.C - rounding_per_size * C_terms};
}

// The range of m, within [0, 1], in which two boxes may overlap. It is empty if enter > leave.
struct Overlap
{
    double enter = 0, leave = 1;

    // Two sides are apart while gap + m slope > 0.
    void narrow(double gap, double slope)
    {
        if (gap > 0)
            enter = slope >= 0 ? std::numeric_limits<double>::infinity() : std::max(enter, gap / -slope);
        else if (slope > 0)
            leave = std::min(leave, -gap / slope);
    }
};

// The envelope from time t on. Its deviation includes the rounding error of the shift.
Envelope advanced(const Envelope &envelope, double t)
{
    Envelope later = envelope.advanced(t);
    later.deviation.a += rounding_per_size * size_of_terms(envelope.path, t).sum();
    return later;
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

std::optional<double> box_time_of_proximity(const Envelope &first, const Envelope &second, double duration)
{
    const Path path = relative_path(first.path, second.path);
    const Deviation deviation = first.deviation + second.deviation;
    const double growth = deviation.growth(duration);
    const Vector3 chord = duration * (path.velocity + (0.5 * duration) * path.acceleration);
    const Vector3 path_terms = size_of_terms(first.path, duration) + size_of_terms(second.path, duration);
    Overlap overlap;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double above = path.position[axis] + second.low[axis] - first.high[axis];
        const double below = first.low[axis] - path.position[axis] - second.high[axis];
        const double terms = path_terms[axis] + deviation.a + growth + std::abs(first.low[axis]) +
                             std::abs(first.high[axis]) + std::abs(second.low[axis]) + std::abs(second.high[axis]);
        const double reach = deviation.a + 0.125 * duration * duration * std::abs(path.acceleration[axis]) +
                             rounding_per_size * (std::isfinite(terms) ? terms : 0);
        overlap.narrow(above - reach, chord[axis] - growth);
        overlap.narrow(below - reach, -chord[axis] - growth);
    }
    if (overlap.enter > (1 + rounding_per_size) * std::min(overlap.leave, 1.0))
        return std::nullopt;
    return std::min(overlap.enter * (1 - rounding_per_size), 1.0) * duration;
}

std::optional<double> time_in_halves(TimeOfProximity &time, const Envelope &first, const Envelope &second,
                                     double duration, int halvings)
{
    const std::optional<double> found = time(first, second, duration);
    const bool bends =
        first.path.acceleration != second.path.acceleration || (first.deviation + second.deviation).c > 0;
    if (!found || halvings == 0 || !bends)
        return found;
    const double half = 0.5 * duration;
    if (const auto early = time_in_halves(time, first, second, half, halvings - 1))
        return early;
    const auto late = time_in_halves(time, advanced(first, half), advanced(second, half), half, halvings - 1);
    return late ? std::optional<double>(half + *late) : std::nullopt;
}
} // namespace ode_predictive_space
