#include "ode_predictive_space/prediction/proximity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_predictive_space
{
namespace
{
constexpr double epsilon = 8 * std::numeric_limits<double>::epsilon();

// What rounding can add to a distance between points of these paths.
double rounding(const Path &first, const Path &second, int axis, double duration)
{
    const double travel = std::abs(first.velocity[axis]) + std::abs(second.velocity[axis]) +
                          duration * (std::abs(first.acceleration[axis]) + std::abs(second.acceleration[axis]));
    return epsilon * (std::abs(first.position[axis]) + std::abs(second.position[axis]) + duration * travel);
}

// The part of [0, 1] in which linear functions are <= 0; each call cuts it by one of them.
struct Overlap
{
    double enter = 0;
    double leave = 1;

    // f(m) = from + (to - from) m. Infinite values are at the same sign at both ends.
    void restrict_to_negative(double from, double to)
    {
        if (from > 0 && to > 0)
            leave = -1;
        else if (from > 0)
            enter = std::max(enter, from / (from - to));
        else if (to > 0)
            leave = std::min(leave, from / (from - to));
    }
};
} // namespace

std::optional<double> first_root(double A, double B, double C)
{
    if (C <= 0)
        return 0.0;
    const double D = B * B - A * C;
    if (D < 0)
        return std::nullopt;
    const double denominator = std::sqrt(D) - B;
    if (!(denominator > 0))
        return std::nullopt;
    return C / denominator;
}

ProximityPolynomial proximity_polynomial(const Envelope &first, const Envelope &second, double duration, double error)
{
    const Path path = relative_path(first.path, second.path);
    const Vector3 chord = path.at(duration) - path.position;
    const double reach = first.deviation.a + second.deviation.a + first.radius + second.radius + error;
    const double growth = first.deviation.at(duration) - first.deviation.a + second.deviation.at(duration) -
                          second.deviation.a;
    return {chord.squaredNorm() - growth * growth, path.position.dot(chord) - reach * growth,
            path.position.squaredNorm() - reach * reach};
}

double sphere_chord_error(const Envelope &first, const Envelope &second, double duration)
{
    return chord_error(second.path.acceleration - first.path.acceleration, duration);
}

std::optional<double> sphere_time_of_proximity(const Envelope &first, const Envelope &second, double duration)
{
    if (!std::isfinite(first.radius) || !std::isfinite(second.radius))
        return 0.0;
    double error = sphere_chord_error(first, second, duration);
    for (int axis = 0; axis < 3; ++axis)
        error += rounding(first.path, second.path, axis, duration);
    const ProximityPolynomial P = proximity_polynomial(first, second, duration, error);
    const std::optional<double> m = first_root(P.A, P.B, P.C);
    if (!m || *m > 1 + epsilon)
        return std::nullopt;
    return std::min(*m * (1 - epsilon), 1.0) * duration;
}

std::optional<double> box_time_of_proximity(const Envelope &first, const Envelope &second, double duration)
{
    const Path path = relative_path(first.path, second.path);
    const Vector3 end = path.at(duration);
    const double reach = first.deviation.a + second.deviation.a;
    const double reach_at_end = first.deviation.at(duration) + second.deviation.at(duration);
    Overlap overlap;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double error = 0.125 * duration * duration * std::abs(path.acceleration[axis]) +
                             rounding(first.path, second.path, axis, duration);
        const double above = second.low[axis] - first.high[axis] - error;
        const double below = first.low[axis] - second.high[axis] - error;
        overlap.restrict_to_negative(above + path.position[axis] - reach, above + end[axis] - reach_at_end);
        overlap.restrict_to_negative(below - path.position[axis] - reach, below - end[axis] - reach_at_end);
    }
    if (overlap.enter > overlap.leave + epsilon)
        return std::nullopt;
    return overlap.enter * (1 - epsilon) * duration;
}
} // namespace ode_predictive_space
