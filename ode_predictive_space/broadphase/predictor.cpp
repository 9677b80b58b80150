#include "ode_predictive_space/broadphase/predictor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_predictive_space
{
namespace
{
// Ticks for which a prediction is believed as long as nothing speaks against it. Where much touches much, what has swept
// farther before it breaks costs more than what is predicted once more.
constexpr std::uint32_t first_horizon = 1024;

// An object that would need longer than this to use up half of its slack is treated as still.
constexpr double still_ticks = 64;

// How far an envelope may reach along its path, in sizes of its object. Longer sweeps find more candidates than they save
// predictions.
constexpr double reach_alone = 9;
constexpr double reach_crowded = 1;

// How far the deviation may grow by its rate, in sizes. A deviation as wide as the object has others tested that are far
// away; it would also hide that the path is wrong, so that the rate would never be found to be too large.
constexpr double most_widening = 0.4;

// Slack that every object of the environment gets once it has moved, in sizes: for jitter, and for what turning does to a
// bounding box.
constexpr double slack_of_centre = 0.015;
constexpr double slack_of_bounds = 0.03;

// An object that has come to rest is looked at once more after about so many ticks: if it has not moved at all, it gets no
// slack any more, which would keep it near what lies beside it.
constexpr std::uint32_t settling_ticks = 128;

// Samples of an object whose path broke tell about its motion only when they are recent.
constexpr std::int32_t recent_ticks = 8;

// Times in a row that a body's velocity may fail to explain its motion before the positions themselves are believed.
constexpr std::uint8_t patience = 3;

double component_or(double value, double otherwise)
{
    return std::isfinite(value) ? value : otherwise;
}

Vector3 finite_or_zero(const Vector3 &vector)
{
    return vector.allFinite() && vector.squaredNorm() < 1e30 ? vector : Vector3::Zero();
}

// The middle of what is finite of a box.
Vector3 finite_centre(const Box &box)
{
    Vector3 centre;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double low = component_or(box.min()[axis], box.max()[axis]);
        centre[axis] = component_or(0.5 * (low + component_or(box.max()[axis], low)), 0);
    }
    return centre;
}

// The box relative to the centre. Rounding must not make it smaller: neither here nor when it is put back in its place.
Box relative_to(const Vector3 &centre, const Box &box)
{
    const double unit = 4 * std::numeric_limits<double>::epsilon();
    const Vector3 below = unit * (centre.cwiseAbs() + box.min().cwiseAbs());
    const Vector3 above = unit * (centre.cwiseAbs() + box.max().cwiseAbs());
    return Box(box.min() - centre - below, box.max() - centre + above);
}

// Distance from the centre, which the box is relative to.
double farthest_corner(const FloatBox &box)
{
    return Vector3(std::max(-box.low[0], box.high[0]), std::max(-box.low[1], box.high[1]),
                   std::max(-box.low[2], box.high[2]))
        .norm();
}

Box cube(double half)
{
    return Box(Vector3::Constant(-half), Vector3::Constant(half));
}

// Tight bounds of what turns are left when their slack is used up. Are they likely to last so long that they pay?
bool tight_bounds_last(const Observation &seen, double step)
{
    constexpr double least_ticks = 20;
    return !seen.is_sphere && least_ticks * step * seen.spin < slack_of_bounds;
}

// What is rigid stays within a ball that holds its bounding box once, however it turns: within the cube around that ball.
// Each prediction sees another; the smallest one that has not been left is kept.
Box cube_to_turn_in(const PackedBounds &last, const FloatBox &box)
{
    constexpr double margin = 1e-5; // for rounding as it turns
    const float farthest_side =
        std::max(-*std::min_element(box.low, box.low + 3), *std::max_element(box.high, box.high + 3));
    const double corner = (1 + margin) * farthest_corner(box);
    const bool was_in_cube = last.check == Check::bounds && !last.tight_bounds_last;
    return cube(was_in_cube && farthest_side <= last.high[0] ? std::min<double>(last.high[0], corner) : corner);
}

void set_bounds(PackedBounds &bounds, const Observation &seen, const Vector3 &centre, double step)
{
    const bool tight_bounds_last = ode_predictive_space::tight_bounds_last(seen, step);
    FloatBox box = FloatBox::around(seen.bounds ? relative_to(centre, *seen.bounds) : cube(seen.radius));
    const bool has_sphere = std::isfinite(seen.radius);
    if (seen.bounds && seen.centre && !has_sphere && !tight_bounds_last && box.bounded())
        box = FloatBox::around(cube_to_turn_in(bounds, box));
    std::copy_n(box.low, 3, bounds.low);
    std::copy_n(box.high, 3, bounds.high);
    bounds.radius = round_up(seen.box_only ? std::numeric_limits<double>::infinity()
                             : seen.bounds ? farthest_corner(box)
                                           : seen.radius);
    bounds.check = seen.bounds ? Check::bounds : Check::centre;
    bounds.tight_bounds_last = tight_bounds_last;
}

double reach_of(const PackedBounds &bounds)
{
    return bounds.crowded ? reach_crowded : reach_alone;
}

// Half the mean extent of the finite sides.
double size_of(const PackedBounds &bounds)
{
    double sum = 0;
    int sides = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double extent = 0.5 * (double{bounds.high[axis]} - bounds.low[axis]);
        if (extent < 1e15)
        {
            sum += extent;
            ++sides;
        }
    }
    return sides > 0 ? sum / sides : 0;
}

bool is_bounded(const PackedBounds &bounds)
{
    return FloatBox{{bounds.low[0], bounds.low[1], bounds.low[2]}, {bounds.high[0], bounds.high[1], bounds.high[2]}}
        .bounded();
}

// Ticks until the path has gone so far. The root of speed t + 1/2 acceleration t^2 + spread t = distance.
double ticks_to_travel(double distance, double speed, double acceleration)
{
    const double root = std::sqrt(speed * speed + 2 * acceleration * distance);
    return 2 * distance / (speed + root);
}

// A number that looks like chance, and like another chance for the next generation: lengths that hung together would add up
// to the same tick after all.
std::uint32_t scrambled(ProxyId id, Generation generation)
{
    std::uint32_t bits = id * 0x9e3779b1u + generation * 0x85ebca77u;
    bits = (bits ^ (bits >> 15)) * 0x2c1b3c6du;
    bits = (bits ^ (bits >> 12)) * 0x297a2d39u;
    return bits ^ (bits >> 15);
}

// Objects predicted together must not expire together: lengths vary by number and generation, by a half; those of first
// predictions, which are made for all objects at once, by more.
std::uint32_t stagger(std::uint32_t horizon, ProxyId id, Generation generation, bool first)
{
    const std::uint32_t spread = first ? horizon - horizon / 8 : horizon / 2;
    return horizon - static_cast<std::uint32_t>((std::uint64_t{scrambled(id, generation)} * (spread + 1)) >> 32);
}

void pack(PackedPath &packed, const Path &path, const Deviation &deviation, Tick now)
{
    packed.set_path(path);
    packed.set_deviation(deviation);
    packed.since = now;
}
} // namespace

// How the last prediction turned out.
struct Predictor::Outcome
{
    bool fresh = true;    // there was none
    bool moved = false;   // not where it was when it was made
    bool kept = true;     // ended within its envelope
    bool settled = false; // rested within its slack until it was looked at once more
    double ticks = 0;     // since it was made
    double error = 0;     // distance from the path now
    Vector3 displacement = Vector3::Zero();
    Vector3 before = Vector3::Zero();       // where it was
    Vector3 acceleration = Vector3::Zero(); // that it was thought to have
};

struct Predictor::Motion
{
    Vector3 velocity = Vector3::Zero();     // per tick
    Vector3 acceleration = Vector3::Zero(); // per tick^2
    bool brief = false;                     // a mere guess: to be seen again at the next tick

    // What follows a leap is anybody's guess. It is looked at again at the next tick, from where it is.
    static Motion unknown()
    {
        Motion motion;
        motion.brief = true;
        return motion;
    }

    // Does it get farther in one tick than an envelope reaches?
    bool leaps(double reach) const { return !((velocity + 0.5 * acceleration).norm() <= reach); }

    // Does an object that moves so need long to get so far?
    bool stays_within(double distance) const
    {
        const double travel = still_ticks * (velocity.norm() + 0.5 * still_ticks * acceleration.norm());
        return !brief && travel <= distance;
    }
};

Predictor::Outcome Predictor::judge(const ProxyStore &proxies, ProxyId id, const Vector3 &centre, Tick now) const
{
    Outcome outcome;
    const PackedBounds &bounds = proxies.bounds[id];
    if (bounds.check == Check::none)
        return outcome;
    const Path path = proxies.paths[id].path();
    outcome.fresh = false;
    outcome.ticks = ticks_between(proxies.paths[id].since, now);
    outcome.before = path.position;
    outcome.displacement = finite_or_zero(centre - path.position);
    outcome.moved = !outcome.displacement.isZero(0);
    const double elapsed = bounds.still ? 0 : outcome.ticks;
    outcome.acceleration = path.acceleration;
    outcome.error = finite_or_zero(centre - path.at(elapsed)).lpNorm<Eigen::Infinity>();
    outcome.kept = outcome.error <= proxies.paths[id].deviation().at(elapsed);
    outcome.settled = bounds.still && outcome.kept && outcome.ticks >= 0.5 * settling_ticks;
    return outcome;
}

Predictor::Motion Predictor::motion_of_body(PackedBounds &bounds, const Outcome &outcome, const Vector3 &velocity)
{
    const Vector3 last(bounds.last_velocity[0], bounds.last_velocity[1], bounds.last_velocity[2]);
    for (int axis = 0; axis < 3; ++axis)
        bounds.last_velocity[axis] = static_cast<float>(velocity[axis]);
    Motion motion;
    bool explained = true;
    if (outcome.fresh)
        motion.brief = step_estimate.step() == 0 && !velocity.isZero(0);
    else if (outcome.ticks == 0)
        motion.acceleration = outcome.kept ? outcome.acceleration : Vector3::Zero();
    else
    {
        step_estimate.add(outcome.displacement, last, velocity, outcome.ticks);
        const Vector3 expected = (0.5 * step_estimate.step() * outcome.ticks) * (last + velocity);
        const double error = (outcome.displacement - expected).norm();
        const double travelled = outcome.displacement.norm();
        explained = error <= 0.25 * travelled + 0.5 * slack_of_centre * size_of(bounds);
        // A bounce within the interval would look like an enormous acceleration: believe only what the path bears out.
        if (error <= 0.1 * travelled)
            motion.acceleration = (step_estimate.step() / outcome.ticks) * (velocity - last);
    }
    bounds.mistrust = explained ? 0 : static_cast<std::uint8_t>(std::min<int>(bounds.mistrust + 1, patience));
    // ODE moves a body with the velocity that it has at the end of the step, hence the half step.
    motion.velocity = step_estimate.step() * velocity + 0.5 * motion.acceleration;
    return motion;
}

History &Predictor::history_of(PackedBounds &bounds)
{
    if (bounds.history == no_history)
    {
        if (free_histories_.empty())
        {
            bounds.history = static_cast<std::uint32_t>(histories_.size());
            histories_.emplace_back();
        }
        else
        {
            bounds.history = free_histories_.back();
            free_histories_.pop_back();
            histories_[bounds.history] = History();
        }
    }
    return histories_[bounds.history];
}

Predictor::Motion Predictor::motion_from_history(PackedBounds &bounds, const Outcome &outcome, const Vector3 &centre,
                                                 Tick now)
{
    Motion motion;
    if ((!outcome.moved && bounds.history == no_history) || !centre.allFinite())
        return motion;
    const bool was_still = bounds.still;
    History &history = history_of(bounds);
    if (!outcome.kept)
    {
        history.keep_recent(now, recent_ticks);
        // What stood still was still there one tick ago.
        if (was_still && history.count() == 0 && !outcome.fresh)
            history.add(now - 1, outcome.before);
    }
    history.add(now, centre);
    motion.brief = history.count() < 3;
    const FittedPath fitted = history.fit();
    motion.velocity = finite_or_zero(fitted.path.velocity);
    motion.acceleration = finite_or_zero(fitted.path.acceleration);
    return motion;
}

// Longer after a prediction that held, shorter after one that broke; the same for how closely it is believed.
void Predictor::adapt(PackedBounds &bounds, const Outcome &outcome, double speed, double size) const
{
    if (bounds.horizon == 0)
    {
        bounds.horizon = std::min(first_horizon, horizon.max_ticks);
        bounds.spread = static_cast<float>(0.01 * speed);
        return;
    }
    if (outcome.ticks == 0)
        return;
    const double drift = outcome.error / outcome.ticks;
    double spread = bounds.spread;
    if (outcome.kept)
    {
        bounds.horizon *= 2;
        spread = std::max(0.5 * spread, 2 * drift);
    }
    else
    {
        bounds.horizon /= 2;
        // A jump says nothing about the drift to come.
        if (drift * bounds.horizon < size)
            spread = std::max(spread, drift);
    }
    bounds.horizon = std::clamp(bounds.horizon, horizon.min_ticks, horizon.max_ticks);
    bounds.spread = static_cast<float>(std::clamp(spread, 0.002 * speed, std::max(0.5 * speed, 0.01 * size)));
}

Deviation Predictor::allow(const PackedBounds &bounds, const Outcome &outcome, double size) const
{
    if (const auto &fixed = deviation[is_interactive(bounds.role) ? 1 : 0])
        return bounds.still ? Deviation{fixed->a, 0, 0} : *fixed;
    if ((outcome.fresh || (outcome.settled && !outcome.moved)) && bounds.still)
        return {};
    const double slack = (bounds.check == Check::centre ? slack_of_centre : slack_of_bounds) * size;
    return bounds.still ? Deviation{slack, 0, 0} : Deviation{slack, bounds.spread, 0};
}

Predictor::Motion Predictor::estimate_motion(PackedBounds &bounds, const Outcome &outcome, const Observation &seen,
                                             const Vector3 &centre, Tick now)
{
    if (!seen.velocity && outcome.moved && bounds.role == Role::environment)
        bounds.role = Role::interactive;
    const bool has_body = seen.velocity && bounds.role != Role::fixed_interactive;
    Motion motion;
    if (has_body)
        motion = motion_of_body(bounds, outcome, finite_or_zero(*seen.velocity));
    if (!has_body || bounds.mistrust >= patience)
    {
        const Motion as_seen = motion_from_history(bounds, outcome, centre, now);
        // A few positions tell less than a velocity by which the object has kept to its prediction.
        if (!has_body || !as_seen.brief || !outcome.kept)
            motion = as_seen;
    }
    return motion;
}

std::uint32_t Predictor::horizon_for(const PackedBounds &bounds, const Motion &motion, double size) const
{
    if (motion.brief)
        return 1;
    const double far =
        ticks_to_travel(reach_of(bounds) * size, motion.velocity.norm() + bounds.spread, motion.acceleration.norm());
    const double wide = most_widening * size / (bounds.spread + std::numeric_limits<double>::min());
    return std::min(bounds.horizon, static_cast<std::uint32_t>(std::min({1e9, far, wide})));
}

Tick Predictor::end_of_horizon(Tick now, std::uint32_t ticks) const
{
    // The rhythm shifts by a tick in so many, or what a program does every so many ticks could meet it each time.
    constexpr Tick steady = 64;
    const Tick end = now + ticks;
    const std::uint32_t earlier = (end + end / steady) % gather;
    const bool hardly_shorter = ticks >= 4 * gather && ticks - earlier >= horizon.min_ticks;
    return hardly_shorter ? end - earlier : end;
}

void Predictor::predict(ProxyStore &proxies, ProxyId id, const Observation &seen, Tick now)
{
    PackedBounds &bounds = proxies.bounds[id];
    const Vector3 centre = seen.centre ? *seen.centre : finite_centre(*seen.bounds);
    const Outcome outcome = judge(proxies, id, centre, now);
    Motion motion = estimate_motion(bounds, outcome, seen, centre, now);

    set_bounds(bounds, seen, centre, step());
    proxies.stamps[id] = {bounds.check == Check::centre ? bounds.radius : -1, 0};
    const double size = size_of(bounds);
    if (motion.leaps(reach_of(bounds) * size))
        motion = Motion::unknown();
    const bool is_first = bounds.horizon == 0;
    adapt(bounds, outcome, motion.velocity.norm(), size);

    bounds.still = true;
    const Deviation slack = allow(bounds, outcome, size);
    bounds.still = !is_bounded(bounds) || motion.stays_within(0.5 * slack.a);
    const Generation generation = proxies.generations[id];
    if (bounds.still)
    {
        pack(proxies.paths[id], {centre, Vector3::Zero(), Vector3::Zero()}, slack, now);
        const bool settles = !outcome.fresh && !outcome.settled;
        bounds.until = settles ? end_of_horizon(now, stagger(settling_ticks, id, generation, false)) : now;
    }
    else
    {
        pack(proxies.paths[id], {centre, motion.velocity, motion.acceleration}, allow(bounds, outcome, size), now);
        const std::uint32_t ticks = stagger(horizon_for(bounds, motion, size), id, generation, is_first);
        bounds.until = end_of_horizon(now, std::clamp(ticks, horizon.min_ticks, horizon.max_ticks));
    }
    // How a mere guess turns out says nothing about the next prediction.
    if (motion.brief)
        bounds.horizon = 0;
    ++proxies.generations[id];
}

void Predictor::remember(const ProxyStore &proxies, ProxyId id, const Vector3 &centre, Tick now)
{
    const std::uint32_t history = proxies.bounds[id].history;
    if (history != no_history && centre.allFinite())
        histories_[history].add(now, centre);
}

void Predictor::forget(ProxyStore &proxies, ProxyId id)
{
    std::uint32_t &history = proxies.bounds[id].history;
    if (history != no_history)
        free_histories_.push_back(history);
    history = no_history;
}

std::size_t Predictor::bytes() const
{
    return histories_.capacity() * sizeof(History) + free_histories_.capacity() * sizeof(std::uint32_t);
}
} // namespace ode_predictive_space
