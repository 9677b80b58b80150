#include "tests/prediction/random_pairs.h"

#include <cmath>

namespace ode_predictive_space
{
// The relative motion at a time in the horizon or a little outside; the paths are made from it.
struct RandomPairs::Encounter
{
    double time;
    Vector3 offset;
    Vector3 velocity;
    Vector3 acceleration;
};

double RandomPairs::uniform(double low, double high)
{
    return std::uniform_real_distribution<double>(low, high)(engine_);
}

double RandomPairs::log_uniform(double low, double high)
{
    return std::exp(uniform(std::log(low), std::log(high)));
}

double RandomPairs::nearly_one()
{
    return 1 + sign() * log_uniform(1e-16, 0.1);
}

Vector3 RandomPairs::direction()
{
    for (;;)
    {
        const Vector3 candidate(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        if (candidate.norm() > 0.1 && candidate.norm() < 1)
            return candidate.normalized();
    }
}

Vector3 RandomPairs::perpendicular(const Vector3 &to)
{
    return to.cross(direction()).stableNormalized();
}

Envelope RandomPairs::envelope(double radius)
{
    Envelope result;
    result.radius = radius;
    for (int axis = 0; axis < 3; ++axis)
    {
        result.low[axis] = -radius * uniform(0, 1);
        result.high[axis] = radius * uniform(0, 1);
    }
    return result;
}

// The slab of one axis is left, and that of another is entered, at the same moment or nearly so.
void RandomPairs::draw_corner(const EnvelopePair &pair, Encounter &encounter)
{
    const int leaving = static_cast<int>(uniform(0, 3));
    const int entering = (leaving + 1) % 3;
    const double reach = (pair.first.deviation + pair.second.deviation).at(encounter.time);
    const Vector3 extent = pair.first.high - pair.second.low + Vector3::Constant(reach);
    encounter.offset = 0.5 * extent;
    encounter.offset[leaving] = extent[leaving] * nearly_one();
    encounter.offset[entering] = extent[entering] * nearly_one();
    encounter.velocity[leaving] = std::abs(encounter.velocity[leaving]);
    encounter.velocity[entering] = -std::abs(encounter.velocity[entering]);
}

void RandomPairs::draw_encounter(PairKind kind, const EnvelopePair &pair, Encounter &encounter)
{
    const double T = pair.duration;
    const Deviation deviation = pair.first.deviation + pair.second.deviation;
    const double radii = pair.first.radius + pair.second.radius;
    const double reach = radii + deviation.at(encounter.time);
    const Vector3 ahead = direction();
    encounter.offset = reach * uniform(0, 2) * direction();
    encounter.velocity = log_uniform(0.1, 100) * radii / T * ahead;
    encounter.acceleration = log_uniform(0.01, 10) * radii / (T * T) * direction();
    switch (kind)
    {
    case PairKind::still:
        encounter.offset = reach * nearly_one() * direction();
        encounter.velocity.setZero();
        encounter.acceleration.setZero();
        break;
    case PairKind::slow:
        encounter.velocity = log_uniform(1e-6, 0.1) * radii / T * ahead;
        encounter.acceleration *= 1e-3;
        break;
    case PairKind::fast:
        encounter.velocity = log_uniform(1e2, 1e6) * radii / T * ahead;
        break;
    case PairKind::head_on:
        encounter.offset = -reach * uniform(0, 1.5) * ahead;
        encounter.acceleration.setZero();
        break;
    case PairKind::grazing:
        encounter.offset = reach * nearly_one() * perpendicular(ahead);
        encounter.velocity *= log_uniform(1, 1e4);
        encounter.acceleration.setZero();
        break;
    case PairKind::corner:
        draw_corner(pair, encounter);
        break;
    case PairKind::braking:
        encounter.offset = -reach * nearly_one() * ahead;
        encounter.velocity.setZero();
        encounter.acceleration = -log_uniform(1, 1e3) * radii / (T * T) * ahead;
        break;
    case PairKind::free_fall:
        encounter.acceleration.setZero();
        break;
    case PairKind::curved:
        encounter.acceleration *= log_uniform(1, 1e3);
        break;
    case PairKind::growing_as_moving:
        // The motion is along an axis, with numbers that are exact in binary, so that A is exactly zero.
        encounter.time = 0;
        encounter.offset = reach * uniform(1, 3) * direction();
        encounter.velocity = Vector3(sign() * deviation.b, 0, 0);
        encounter.acceleration.setZero();
        break;
    case PairKind::tangential:
        encounter.time = 0;
        encounter.offset = (radii + deviation.a) * nearly_one() * ahead;
        encounter.velocity = encounter.velocity.norm() * perpendicular(ahead);
        break;
    case PairKind::big_and_small:
    case PairKind::far_from_origin:
    case PairKind::growing_faster_than_moving:
        break;
    }
}

EnvelopePair RandomPairs::make(PairKind kind)
{
    const double size = log_uniform(1e-3, 10);
    const double T = std::floor(log_uniform(1, 1000));
    EnvelopePair pair = {envelope(size), envelope(size * log_uniform(0.1, 10)), T};
    if (kind == PairKind::big_and_small)
        pair.second = envelope(size * log_uniform(1e3, 1e6));

    const double growth = kind == PairKind::growing_faster_than_moving ? log_uniform(1, 1e4) : log_uniform(1e-4, 1);
    pair.first.deviation = {size * uniform(0, 0.1), size * uniform(0, growth) / T, size * uniform(0, growth) / (T * T)};
    pair.second.deviation = {size * uniform(0, 0.1), 0, size * uniform(0, growth) / (T * T)};
    if (kind == PairKind::grazing)
        pair.first.deviation = pair.second.deviation = {size * uniform(0, 0.1), 0, 0};
    if (kind == PairKind::growing_as_moving)
    {
        pair.first.deviation = {size, std::ldexp(1.0, static_cast<int>(uniform(-10, 2))), 0};
        pair.second.deviation = {0, 0, 0};
    }

    Encounter encounter = {T * uniform(-0.2, 1.2), Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
    draw_encounter(kind, pair, encounter);
    const double back = encounter.time;
    const Path relative = {encounter.offset - back * (encounter.velocity - 0.5 * back * encounter.acceleration),
                           encounter.velocity - back * encounter.acceleration, encounter.acceleration};

    const double distance = kind == PairKind::far_from_origin ? 1e6 : 10;
    Path &path = pair.first.path;
    path.position = distance * uniform(0, 1) * direction();
    if (kind == PairKind::free_fall)
        path.acceleration = Vector3(0, 0, -9.81e-6);
    else if (kind != PairKind::growing_as_moving && kind != PairKind::still)
        path = {path.position, relative.velocity.norm() * uniform(0, 1) * direction(),
                relative.acceleration.norm() * uniform(0, 1) * direction()};
    pair.second.path = {path.position + relative.position, path.velocity + relative.velocity,
                        path.acceleration + relative.acceleration};
    return pair;
}
} // namespace ode_predictive_space
