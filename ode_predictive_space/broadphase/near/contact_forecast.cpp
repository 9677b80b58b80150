#include "ode_predictive_space/broadphase/near/contact_forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/shape/surface_gap.h"

namespace ode_predictive_space
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double next_tick = 1, rounds_down = 1 - 1e-9;

bool is_ball(const ConvexShape &shape)
{
    return shape.kind == ShapeKind::rounded && shape.half_sides.isZero(0);
}

double reach_by_turning(const PredictedShape &object, const PredictedShape &other, const Vector3 &axis)
{
    if (object.still || !object.turns || (object.about_centre && is_ball(object.shape)))
        return 0;
    if (!object.about_centre || (object.shape.blunt_beside & other.shape.group))
        return infinity;
    return std::max(0.0, object.envelope.radius - object.shape.reach(axis));
}

// The first time at which c + b t + a t^2 is not positive. @pre c > 0.
double time_of_closing(double c, double b, double a)
{
    const double half = -0.5 * b, discriminant = half * half - a * c;
    if (discriminant < 0)
        return infinity;
    const double divisor = half + std::sqrt(discriminant);
    return divisor > 0 ? c / divisor : infinity;
}
// The part of a gap to a surface that any rotation of the object may close.
double nearer_by_turning(const PredictedShape &object)
{
    if (object.still || !object.turns || (object.about_centre && is_ball(object.shape)))
        return 0;
    return object.about_centre && !object.shape.blunt_beside ? object.envelope.radius - 0.5 * object.shape.size
                                                             : infinity;
}

// Ticks until a gap of `left` is closed, at least 1; none if it lasts for the duration.
std::optional<double> at_least_next_tick(double left, double speed, double half_acceleration, double duration)
{
    if (!(left > 0))
        return next_tick;
    const double time = rounds_down * time_of_closing(left, speed, half_acceleration);
    return time <= duration ? std::optional(std::max(next_tick, time)) : std::nullopt;
}

// A gap to a surface has no axis, so it may close along any. A surface that moves may be anywhere at the next tick.
std::optional<double> time_beside_surface(const PredictedShape &first, const PredictedShape &second, double margin,
                                          double duration)
{
    const double gap = surface_gap(first.shape, second.shape, margin).length;
    if (!(gap > margin))
        return 0;
    const bool first_is_surface = surface_of(first.shape, second.shape) == &first.shape;
    const PredictedShape &surface = first_is_surface ? first : second, &other = first_is_surface ? second : first;
    if (!surface.still)
        return next_tick;
    const Path &path = other.envelope.path;
    const Deviation deviation = std::sqrt(3.0) * (surface.envelope.deviation + other.envelope.deviation);
    const double left = rounds_down * (gap - margin) - nearer_by_turning(other) - 2 * deviation.a;
    return at_least_next_tick(left, -path.velocity.norm() - deviation.b, -0.5 * path.acceleration.norm() - deviation.c,
                              duration);
}
} // namespace

std::optional<double> time_of_contact(const PredictedShape &first, const PredictedShape &second, double margin,
                                      double duration)
{
    const Gap gap = find_gap(first.shape, second.shape, Vector3::Zero(), margin);
    if (!(gap.length > margin))
        return time_beside_surface(first, second, margin, duration);
    const Path relative = relative_path(first.envelope.path, second.envelope.path);
    // The deviation bounds each coordinate. Along a diagonal, the object may be farther off its path.
    const Deviation deviation = gap.axis.lpNorm<1>() * (first.envelope.deviation + second.envelope.deviation);
    const double left = rounds_down * (gap.length - margin) - reach_by_turning(first, second, gap.axis) -
                        reach_by_turning(second, first, -gap.axis) - 2 * deviation.a;
    return at_least_next_tick(left, gap.axis.dot(relative.velocity) - deviation.b,
                              0.5 * gap.axis.dot(relative.acceleration) - deviation.c, duration);
}
} // namespace ode_predictive_space
