#include "ode_predictive_space/broadphase/predict/predictor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/predict/extent.h"

namespace ode_predictive_space
{
namespace
{
Vector3 finite_or_zero(const Vector3 &vector)
{
    return vector.allFinite() && vector.squaredNorm() < 1e30 ? vector : Vector3::Zero();
}

double reach_of(const ProxyRecord &record)
{
    return record.kind.crowded ? tuning::reach_crowded : tuning::reach_alone;
}

// Ticks until the path has gone so far. The root of speed t + 1/2 acceleration t^2 = distance.
double ticks_to_travel(double distance, double speed, double acceleration)
{
    const double root = std::sqrt(speed * speed + 2 * acceleration * distance);
    return 2 * distance / (speed + root);
}

// Does the object take many ticks to move by its own size?
bool lingers(const ProxyStore &proxies, ProxyId id)
{
    const double speed = proxies.paths[id].path().velocity.lpNorm<Eigen::Infinity>();
    return tuning::lingering_ticks * speed < proxies.records[id].prediction.radius;
}

// A number that looks random, and independent from one generation to the next: lengths that were correlated would add up to the
// same tick after all.
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
    bool moved = false;   // the object is not where it was at the prediction
    bool kept = true;     // the object is within its envelope
    bool settled = false; // the object rested within its slack until it was looked at once more
    double ticks = 0;     // since the prediction
    double error = 0;     // distance from the path now
    Vector3 displacement = Vector3::Zero();
    Vector3 before = Vector3::Zero();       // where the object was
    Vector3 acceleration = Vector3::Zero(); // as predicted
};

struct Predictor::Motion
{
    Vector3 velocity = Vector3::Zero();     // per tick
    Vector3 acceleration = Vector3::Zero(); // per tick^2
    bool brief = false;                     // a mere guess: the object is to be seen again at the next tick

    // After a leap nothing is known. The object is looked at again at the next tick, from where it is then.
    static Motion unknown()
    {
        Motion motion;
        motion.brief = true;
        return motion;
    }

    // Does the object get farther in one tick than an envelope reaches?
    bool leaps(double reach) const { return !((velocity + 0.5 * acceleration).norm() <= reach); }

    // Does the object need long to get so far?
    bool stays_within(double distance) const
    {
        const double travel = tuning::still_ticks * (velocity.norm() + 0.5 * tuning::still_ticks * acceleration.norm());
        return !brief && travel <= distance;
    }
};

Predictor::Outcome Predictor::judge(const ProxyStore &proxies, ProxyId id, const Vector3 &centre, Tick now) const
{
    Outcome outcome;
    const ProxyRecord &record = proxies.records[id];
    if (record.kind.check == Check::none)
        return outcome;
    const Path path = proxies.paths[id].path();
    outcome.fresh = false;
    outcome.ticks = ticks_between(proxies.paths[id].since, now);
    outcome.before = path.position;
    outcome.displacement = finite_or_zero(centre - path.position);
    outcome.moved = !outcome.displacement.isZero(0);
    const double elapsed = record.kind.still ? 0 : outcome.ticks;
    outcome.acceleration = path.acceleration;
    outcome.error = finite_or_zero(centre - path.at(elapsed)).lpNorm<Eigen::Infinity>();
    outcome.kept = outcome.error <= proxies.paths[id].deviation().at(elapsed);
    outcome.settled = record.kind.still && outcome.kept && outcome.ticks >= 0.5 * tuning::settling_ticks;
    return outcome;
}

Predictor::Motion Predictor::motion_of_body(ProxyRecord &record, const Outcome &outcome, const Vector3 &velocity)
{
    float *const remembered = record.learned.last_velocity;
    const Vector3 last(remembered[0], remembered[1], remembered[2]);
    for (int axis = 0; axis < 3; ++axis)
        remembered[axis] = static_cast<float>(velocity[axis]);
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
        explained = error <= 0.25 * travelled + 0.5 * tuning::slack_of_centre * size_of(record.prediction);
        // A bounce within the interval would look like an enormous acceleration: only what agrees with the path counts.
        if (error <= 0.1 * travelled)
            motion.acceleration = (step_estimate.step() / outcome.ticks) * (velocity - last);
    }
    std::uint8_t &mistrust = record.kind.mistrust;
    mistrust = explained ? 0 : static_cast<std::uint8_t>(std::min<int>(mistrust + 1, tuning::patience));
    // ODE moves a body with the velocity that it has at the end of the step, hence the half step.
    motion.velocity = step_estimate.step() * velocity + 0.5 * motion.acceleration;
    return motion;
}

History &Predictor::history_of(ProxyRecord &record)
{
    std::uint32_t &number = record.learned.history;
    if (number != no_history)
        return histories_[number];
    if (free_histories_.empty())
    {
        histories_.emplace_back();
        number = static_cast<std::uint32_t>(histories_.size() - 1);
    }
    else
    {
        number = free_histories_.back();
        free_histories_.pop_back();
        histories_[number] = History();
    }
    return histories_[number];
}

Predictor::Motion Predictor::motion_from_history(ProxyRecord &record, const Outcome &outcome, const Vector3 &centre,
                                                 Tick now)
{
    Motion motion;
    if ((!outcome.moved && record.learned.history == no_history) || !centre.allFinite())
        return motion;
    const bool was_still = record.kind.still;
    History &history = history_of(record);
    if (!outcome.kept)
    {
        history.keep_recent(now, tuning::recent_ticks);
        // A still object was there one tick ago, too.
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

// The horizon is longer after a prediction that held and shorter after one that broke. The deviation narrows and widens likewise.
void Predictor::adapt(ProxyRecord &record, const Outcome &outcome, double speed, double size) const
{
    ProxyRecord::Learned &learned = record.learned;
    if (learned.horizon == 0)
    {
        learned.horizon = std::min(tuning::first_horizon, settings.horizon.max_ticks);
        learned.spread = static_cast<float>(0.01 * speed);
        return;
    }
    if (outcome.ticks == 0)
        return;
    const double drift = outcome.error / outcome.ticks;
    double spread = learned.spread;
    if (outcome.kept)
    {
        learned.horizon *= 2;
        spread = std::max(0.5 * spread, 2 * drift);
    }
    else
    {
        learned.horizon /= 2;
        // A jump says nothing about the drift to come.
        if (drift * learned.horizon < size)
            spread = std::max(spread, drift);
    }
    learned.horizon = std::clamp(learned.horizon, settings.horizon.min_ticks, settings.horizon.max_ticks);
    learned.spread = static_cast<float>(std::clamp(spread, 0.002 * speed, std::max(0.5 * speed, 0.01 * size)));
}

Deviation Predictor::allow(const ProxyRecord &record, const Outcome &outcome, double size) const
{
    if (const auto &fixed = settings.deviation[is_interactive(record.role) ? 1 : 0])
        return record.kind.still ? Deviation{fixed->a, 0, 0} : *fixed;
    if ((outcome.fresh || (outcome.settled && !outcome.moved)) && record.kind.still)
        return {};
    const double slack =
        (record.kind.check == Check::centre ? tuning::slack_of_centre : tuning::slack_of_bounds) * size;
    return record.kind.still ? Deviation{slack, 0, 0} : Deviation{slack, record.learned.spread, 0};
}

Predictor::Motion Predictor::estimate_motion(ProxyRecord &record, const Outcome &outcome, const Observation &seen,
                                             const Vector3 &centre, Tick now)
{
    if (!seen.velocity && outcome.moved && record.role == Role::environment)
        record.role = Role::interactive;
    const bool has_body = seen.velocity && record.role != Role::fixed_interactive;
    Motion motion;
    if (has_body)
        motion = motion_of_body(record, outcome, finite_or_zero(*seen.velocity));
    if (!has_body || record.kind.mistrust >= tuning::patience)
    {
        const Motion as_seen = motion_from_history(record, outcome, centre, now);
        // A few positions tell less than a velocity whose last prediction held.
        if (!has_body || !as_seen.brief || !outcome.kept)
            motion = as_seen;
    }
    return motion;
}

std::uint32_t Predictor::horizon_for(const ProxyRecord &record, const Motion &motion, double size) const
{
    if (motion.brief)
        return 1;
    const double speed = motion.velocity.norm() + record.learned.spread;
    const double far = ticks_to_travel(reach_of(record) * size, speed, motion.acceleration.norm());
    const double wide = tuning::most_widening * size / (record.learned.spread + std::numeric_limits<double>::min());
    return std::min(record.learned.horizon, static_cast<std::uint32_t>(std::min({1e9, far, wide})));
}

void Predictor::predict(ProxyStore &proxies, ProxyId id, const Observation &seen, Tick now)
{
    ProxyRecord &record = proxies.records[id];
    const Vector3 centre = centre_of(seen);
    const Outcome outcome = judge(proxies, id, centre, now);
    Motion motion = estimate_motion(record, outcome, seen, centre, now);

    set_extent(record, seen, centre, step_estimate.step());
    proxies.stamps[id] = {record.kind.check == Check::centre ? record.prediction.radius : Stamp::by_bounds, 0};
    const double size = size_of(record.prediction);
    if (motion.leaps(reach_of(record) * size))
        motion = Motion::unknown();
    const bool is_first = record.learned.horizon == 0;
    adapt(record, outcome, motion.velocity.norm(), size);

    record.kind.still = true;
    const Deviation slack = allow(record, outcome, size);
    record.kind.still = !is_bounded(record.prediction) || motion.stays_within(0.5 * slack.a);
    const Generation generation = proxies.generations[id];
    if (record.kind.still)
    {
        pack(proxies.paths[id], {centre, Vector3::Zero(), Vector3::Zero()}, slack, now);
        const bool settles = !outcome.fresh && !outcome.settled;
        record.prediction.until = now + (settles ? stagger(tuning::settling_ticks, id, generation, false) : 0);
    }
    else
    {
        pack(proxies.paths[id], {centre, motion.velocity, motion.acceleration}, allow(record, outcome, size), now);
        const std::uint32_t ticks = stagger(horizon_for(record, motion, size), id, generation, is_first);
        record.prediction.until = now + std::clamp(ticks, settings.horizon.min_ticks, settings.horizon.max_ticks);
    }
    // How a mere guess turns out says nothing about the next prediction.
    if (motion.brief)
        record.learned.horizon = 0;
    ++proxies.generations[id];
}

void Predictor::predict(Scene &scene, ProxyStore &proxies, const Batch &batch, const IdSet &near, Tick now)
{
    constexpr std::size_t most = tuning::objects_per_call;
    std::array<bool, most> with_bounds;
    seen_.resize(most);
    for (std::size_t begin = 0; begin < batch.size(); begin += most)
    {
        const ProxyId *const ids = batch.ids().data() + begin;
        const std::size_t count = std::min(most, batch.size() - begin);
        for (std::size_t i = 0; i < count; ++i)
        {
            proxies.prefetch(ids[i]);
            ProxyRecord::Kind &kind = proxies.records[ids[i]].kind;
            // Tight bounds are given up when they do not last, or were in force and no near pair needed them.
            kind.crowded &= kind.tight_bounds_last && (near.contains(ids[i]) || kind.check != Check::bounds);
            with_bounds[i] = kind.crowded;
        }
        scene.observe(ids, count, with_bounds.data(), seen_.data());
        for (std::size_t i = 0; i < count; ++i)
        {
            predict(proxies, ids[i], seen_[i], now);
            note_prediction(proxies, ids[i]);
        }
    }
}

void Predictor::note_prediction(const ProxyStore &proxies, ProxyId id)
{
    const ProxyRecord &record = proxies.records[id];
    if (record.kind.still)
        moving_.erase(id);
    else
        moving_.insert(id);
    const bool recognised = record.role == Role::interactive && !record.kind.still &&
                            (sampled_.contains(id) || sampled_count_ < tuning::most_sampled);
    set_sampled(id, record.role == Role::fixed_interactive || recognised);
}

void Predictor::set_sampled(ProxyId id, bool wanted)
{
    if (wanted == sampled_.contains(id))
        return;
    if (wanted)
        sampled_.insert(id);
    else
        sampled_.erase(id);
    sampled_count_ += wanted ? 1 : std::size_t{0} - 1;
}

// Always the point that is predicted.
void Predictor::sample_moved(Scene &scene, const ProxyStore &proxies, const IdSet &moved, Tick now)
{
    sampled_.for_each([&](ProxyId id) {
        if (!moved.contains(id))
            return;
        const std::optional<Vector3> pivot = scene.pivot(id);
        sample(proxies, id, pivot ? *pivot : Vector3(scene.bounds(id).center()), now);
    });
}

void Predictor::sample(const ProxyStore &proxies, ProxyId id, const Vector3 &centre, Tick now)
{
    const std::uint32_t history = proxies.records[id].learned.history;
    if (history != no_history && centre.allFinite())
        histories_[history].add(now, centre);
}

void Predictor::note_neighbour(ProxyStore &proxies, ProxyId id)
{
    ProxyRecord::Kind &kind = proxies.records[id].kind;
    if (kind.check == Check::centre && !kind.crowded && kind.tight_bounds_last && lingers(proxies, id))
    {
        kind.crowded = true;
        request(id);
    }
}

void Predictor::take_requests(Batch &batch)
{
    if (!has_requests())
        return;
    requested_.for_each([&](ProxyId id) { batch.add(id); });
    requested_.clear();
    has_requests_ = false;
}

void Predictor::set_role(ProxyStore &proxies, ProxyId id, Role role)
{
    proxies.records[id].role = role;
    if (!is_interactive(role))
        set_sampled(id, false);
    request(id);
}

void Predictor::settings_changed(ProxyStore &proxies)
{
    proxies.members().for_each([&](ProxyId id) {
        std::uint32_t &horizon = proxies.records[id].learned.horizon;
        if (horizon != 0)
            horizon = std::clamp(horizon, settings.horizon.min_ticks, settings.horizon.max_ticks);
        request(id);
    });
}

// No position is sampled meanwhile: whether one is depends on the prediction.
void Predictor::forget_prediction(ProxyStore &proxies, ProxyId id)
{
    proxies.forget_prediction(id);
    moving_.erase(id);
    set_sampled(id, false);
}

void Predictor::forget_predictions(ProxyStore &proxies)
{
    proxies.members().for_each([&](ProxyId id) { proxies.forget_prediction(id); });
    requested_.clear();
    has_requests_ = false;
    moving_.clear();
    sampled_.clear();
    sampled_count_ = 0;
}

void Predictor::forget(ProxyStore &proxies, ProxyId id)
{
    std::uint32_t &history = proxies.records[id].learned.history;
    if (history != no_history)
        free_histories_.push_back(history);
    history = no_history;
    requested_.erase(id);
    moving_.erase(id);
    set_sampled(id, false);
}

void Predictor::resize(std::size_t count)
{
    for (IdSet *set : {&requested_, &moving_, &sampled_})
        set->resize(count);
}

void Predictor::forget_histories(ProxyStore &proxies)
{
    proxies.members().for_each([&](ProxyId id) { proxies.records[id].learned.history = no_history; });
    free_memory(histories_);
    free_memory(free_histories_);
}

std::size_t Predictor::bytes() const
{
    return requested_.bytes() + moving_.bytes() + sampled_.bytes() + bytes_of(histories_) + bytes_of(free_histories_) +
           bytes_of(seen_);
}
} // namespace ode_predictive_space
