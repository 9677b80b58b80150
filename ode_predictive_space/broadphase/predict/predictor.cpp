#include "ode_predictive_space/broadphase/predict/predictor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_predictive_space
{
namespace
{
Vector3 finite_or_zero(const Vector3 &vector)
{
    return vector.allFinite() && vector.squaredNorm() < 1e30 ? vector : Vector3::Zero();
}

Vector3 to_vector(Float4 vector)
{
    float lanes[4];
    vector.store(lanes);
    return {lanes[0], lanes[1], lanes[2]};
}

float norm(Float4 vector)
{
    return std::sqrt((vector * vector).sum_of_three());
}

float dot(Float4 one, Float4 other)
{
    return (one * other).sum_of_three();
}

Float4 load_three(const float *three)
{
    return {three[0], three[1], three[2], 0};
}

// Squares of the results, and of sums of them, are finite.
Float4 bounded(Float4 vector)
{
    const Float4 most = Float4::all(1e15f);
    return min(max(vector, -most), most);
}

Float4 middle_of_finite(const TightBox &box)
{
    return Float4::all(0.5f) * box.low + Float4::all(0.5f) * box.high;
}

// Sides that are not finite count as 0.
Float4 middle_of(const TightBox &box)
{
    return bounded(Float4::all(0.5f) * finite_or_zero(box.low) + Float4::all(0.5f) * finite_or_zero(box.high));
}

// Distance from the beginning of the path to the farthest corner of the box.
double farthest_corner(const Envelope &envelope)
{
    return envelope.low.cwiseAbs().cwiseMax(envelope.high.cwiseAbs()).norm();
}

// The largest finite side; 0 for an inverted box.
float size_of(const TightBox &box)
{
    const Float4 sides = max(box.high - box.low, Float4::all(0));
    if (const float largest = sides.largest_of_three(); largest < 1e15f)
        return largest;
    return finite_or_zero(sides).largest_of_three();
}

float ticks_to_travel(float distance, float speed, float acceleration)
{
    const float pace = speed + std::sqrt(speed * speed + 2 * acceleration * distance);
    return pace > 0 ? 2 * distance / pace : std::numeric_limits<float>::infinity();
}

float scrambled(ProxyId id)
{
    return static_cast<float>((id * 0x9e3779b1u) >> 8) * 0x1p-24f;
}
} // namespace

struct Predictor::Outcome
{
    float ticks = 0;    // since the prediction
    float distance = 0; // length of the predicted displacement
    float error = 0;    // distance from the predicted path
    Float4 displacement = Float4::all(0);
};

struct Predictor::Motion
{
    Float4 velocity = Float4::all(0);     // per tick
    Float4 acceleration = Float4::all(0); // per tick^2

    Float4 displacement(float ticks) const
    {
        return Float4::all(ticks) * (velocity + Float4::all(0.5f * ticks) * acceleration);
    }
};

// The error is the distance from the path, as steps may vary; an object that moved backwards is compared with its beginning.
Predictor::Outcome Predictor::judge(const ProxyRecord &record, Float4 centre, Tick now) const
{
    Outcome outcome;
    outcome.ticks = static_cast<float>(ticks_between(record.since, now));
    outcome.displacement = bounded(centre) - bounded(load_three(record.position));
    const float step = record.has_body ? static_cast<float>(step_estimate_.step()) : 1;
    const Float4 acceleration = load_three(record.acceleration);
    const Motion motion{Float4::all(step) * load_three(record.velocity) + Float4::all(0.5f) * acceleration,
                        acceleration};
    const Float4 expected = bounded(motion.displacement(outcome.ticks));
    const float squared_distance = dot(expected, expected);
    const float along = squared_distance > 0 ? dot(outcome.displacement, expected) / squared_distance : 0;
    const float part = std::max(along, 0.0f);
    outcome.distance = std::sqrt(squared_distance);
    outcome.error = norm(outcome.displacement - Float4::all(part) * expected);
    return outcome;
}

namespace
{
// Reach balances costs: a longer envelope lasts longer, but has more pairs that are apart and still tested at each tick.
void adapt_reach(ProxyRecord &record, float ticks)
{
    const bool too_long = record.useless * ticks > tuning::tests_per_prediction;
    const float reach = too_long ? record.reach / tuning::reach_step : record.reach * tuning::reach_step;
    record.reach = std::clamp(reach, tuning::slack, tuning::most_reach);
}

void adapt_spread(ProxyRecord &record, float distance, float error)
{
    if (distance > tuning::slack * record.size)
        record.spread = std::min(std::max(0.5f * record.spread, 2 * error / distance), tuning::most_spread);
}

Deviation adapted_deviation(float size, float spread, float distance, float ticks)
{
    return {tuning::slack * size, spread * distance / ticks, 0};
}

// An envelope around the bounding sphere is compared with the centre alone until it meets another.
void watch_centre(Place &place, const ProxyRecord &record, const std::optional<Carried> &carried, Float4 doubt)
{
    if (carried)
        place.watch_carried(carried->centre, carried->radius, doubt, carried->offset);
    else
        place.watch_centre(record.position, record.radius, doubt);
}

// The time in which the velocity makes the displacement; 0 if that leaves an error of more than a tenth.
float seconds_of_travel(Float4 displacement, Float4 velocity)
{
    const float squared_speed = dot(velocity, velocity);
    const float seconds = squared_speed > 0 ? dot(displacement, velocity) / squared_speed : 0;
    const bool explained =
        seconds > 0 && norm(displacement - Float4::all(seconds) * velocity) <= 0.1f * norm(displacement);
    return explained ? seconds : 0;
}

// Reaches vary, so that not all objects leave their first envelopes in the same tick.
void begin(ProxyRecord &record, ProxyId id)
{
    record.reach = tuning::first_reach * (0.75f + 0.5f * scrambled(id));
    record.spread = tuning::slack;
    record.predicted = true;
}
} // namespace

Predictor::Motion Predictor::motion_of_body(const ProxyRecord &record, const Outcome &outcome, Float4 velocity)
{
    const Float4 last = load_three(record.velocity);
    Motion motion;
    if (outcome.ticks > 0)
    {
        const Float4 mean = Float4::all(0.5f) * (last + velocity);
        const float travelled = norm(outcome.displacement), seconds = seconds_of_travel(outcome.displacement, mean);
        const bool explained = seconds > 0;
        if (explained)
            step_estimate_.add(to_vector(outcome.displacement), to_vector(last), to_vector(velocity), outcome.ticks);
        const auto step = static_cast<float>(step_estimate_.step());
        if (travelled > 4 * step * outcome.ticks * std::max(norm(last), norm(velocity)))
        {
            // The program sets the body's position itself.
            motion.velocity = Float4::all(1 / outcome.ticks) * outcome.displacement;
            return motion;
        }
        // A bounce would count as an enormous acceleration, so only a change that agrees with the displacement is used.
        if (explained)
            motion.acceleration = Float4::all(step * step / seconds) * (velocity - last);
    }
    // ODE moves a body with the velocity that it has at the end of the step, hence the half step.
    motion.velocity =
        Float4::all(static_cast<float>(step_estimate_.step())) * velocity + Float4::all(0.5f) * motion.acceleration;
    return motion;
}

Predictor::Motion Predictor::motion_of(ProxyRecord &record, const Outcome &outcome, const Observation &seen)
{
    record.is_costly = seen.is_costly;
    const bool moved = norm(outcome.displacement) > 0;
    if (!seen.velocity && moved && record.role == Role::environment)
        record.role = Role::interactive;
    record.has_body = seen.velocity && record.role != Role::fixed_interactive;
    if (record.has_body)
        return motion_of_body(record, outcome, bounded(Float4::nearest(seen.velocity->data())));
    Motion motion;
    if (moved && outcome.ticks > 0)
        motion.velocity = Float4::all(1 / outcome.ticks) * outcome.displacement;
    return motion;
}

float Predictor::ticks_for(float distance, float speed, float acceleration) const
{
    const float ticks = ticks_to_travel(distance, speed, acceleration);
    const auto least = static_cast<float>(settings.horizon.min_ticks);
    const auto most = static_cast<float>(settings.horizon.max_ticks);
    return ticks >= least ? std::min(ticks, most) : ticks < least ? least : most;
}

Deviation Predictor::deviation_of(const ProxyRecord &record, const Deviation &adapted) const
{
    return settings.deviation[is_interactive(record.role) ? 1 : 0].value_or(adapted);
}

// The box that the object sweeps within `ticks`: that of the path with its turning points, enlarged by the deviation.
TightBox Predictor::swept(const TightBox &box, const Motion &motion, float ticks, float deviation)
{
    const Float4 zero = Float4::all(0), end = motion.displacement(ticks);
    Float4 low = min(end, zero), high = max(end, zero);
    const Float4 turn = quotient_or_zero(-motion.velocity, motion.acceleration);
    const Float4 turned = min(max(turn, zero), Float4::all(ticks));
    const Float4 extreme = turned * (motion.velocity + Float4::all(0.5f) * turned * motion.acceleration);
    low = min(low, extreme);
    high = max(high, extreme);
    constexpr float unit = 4 * std::numeric_limits<float>::epsilon();
    const Float4 margin = Float4::all(deviation) + Float4::all(unit) * (abs(low) + abs(high) + Float4::all(deviation));
    const Float4 outer_low = box.low + (low - margin), outer_high = box.high + (high + margin);
    return {min(outer_low, box.low), max(outer_high, box.high)};
}

void Predictor::note_farthest(const TightBox &box)
{
    reviewed_.farthest = max(reviewed_.farthest, max(abs(finite_or_zero(box.low)), abs(finite_or_zero(box.high))));
}

void Predictor::Reviewed::add(const TightBox &envelope)
{
    low = min(low, envelope.low);
    high = max(high, envelope.high);
    sizes += (envelope.high - envelope.low).sum_of_three();
    ++count;
}

// Moving the origin pays if it makes coordinates much smaller, and if rounding is large relative to the objects.
std::optional<Vector3> Predictor::Reviewed::far_middle() const
{
    if (count == 0)
        return std::nullopt;
    const Float4 middle = Float4::all(0.5f) * (low + high), half = Float4::all(0.5f) * (high - low);
    const float distance = abs(middle).largest_of_three();
    const bool is_far = distance > half.largest_of_three() && distance * count > tuning::far_in_sizes * sizes;
    return is_far && distance < 1e15f ? std::optional(to_vector(middle)) : std::nullopt;
}

std::optional<Vector3> Predictor::review(const ProxyStore &proxies)
{
    const std::size_t size = proxies.size();
    const std::size_t some = is_reviewed_ ? size / tuning::ticks_per_review + 1 : size;
    const std::size_t end = std::min(size, reviewed_.end + some);
    for (; reviewed_.end < end; ++reviewed_.end)
        if (const auto id = static_cast<ProxyId>(reviewed_.end); proxies.members().contains(id))
        {
            const TightBox envelope = proxies.places[id].envelope_lanes();
            note_farthest(envelope);
            if (is_finite(envelope))
                reviewed_.add(envelope);
            else
                note_farthest(proxies.places[id].tight_lanes());
        }
    if (end < size)
        return std::nullopt;
    farthest_ = reviewed_.farthest;
    const std::optional<Vector3> middle = reviewed_.far_middle();
    reviewed_ = {};
    is_reviewed_ = true;
    return middle;
}

void Predictor::forget_reviews()
{
    farthest_ = Float4::all(0);
    reviewed_ = {};
    is_reviewed_ = false;
}

void Predictor::predict(ProxyStore &proxies, const Origin &origin, ProxyId id, const Observation &seen, Tick now)
{
    ProxyRecord &record = proxies.records[id];
    Place &place = proxies.places[id];
    const TightBox tight = place.tight_lanes();
    const Float4 centre = seen.centre ? origin.nearest_of_stored(seen.centre->data()) : middle_of(tight);
    Outcome outcome;
    if (!record.predicted)
        begin(record, id);
    else
        outcome = judge(record, centre, now);
    Motion motion = motion_of(record, outcome, seen);
    record.size = size_of(tight);
    record.is_rounded = !(record.size > Place::rounding * norm(bounded(centre)));
    if (outcome.ticks > 0)
    {
        adapt_reach(record, outcome.ticks);
        adapt_spread(record, outcome.distance, outcome.error);
    }
    const float distance = record.reach * record.size, speed = norm(motion.velocity), bend = norm(motion.acceleration);
    // A path that exceeds any reach within a tick is useless.
    if (!(speed + bend < tuning::most_reach * record.size))
        motion = Motion();
    const float ticks = ticks_for(distance, speed, bend);
    const bool never_moved = outcome.ticks == 0 && speed == 0;
    const Deviation adapted = adapted_deviation(record.size, tuning::most_spread, distance, ticks);
    const Deviation deviation = deviation_of(record, never_moved ? Deviation() : adapted);
    record.radius = round_up(seen.radius);
    const bool by_radius = record.tests == 0 && std::isfinite(record.radius) && is_finite(tight);
    const TightBox box = by_radius ? TightBox::around(centre, Float4::all(record.radius), origin.doubt()) : tight;
    const TightBox envelope = swept(box, motion, ticks, static_cast<float>(deviation.at(double{ticks})));
    place.set_envelope(envelope);
    note_farthest(envelope);
    note_farthest(tight);
    centre.store_three(record.position);
    // An infinite envelope is measured again after each move, because it may have become finite.
    if (!place.has_end())
        place.stop_watching();
    else if (by_radius)
        watch_centre(place, record, seen.carried, origin.doubt());
    if (record.has_body)
        bounded(Float4::nearest(seen.velocity->data())).store_three(record.velocity);
    else
        motion.velocity.store_three(record.velocity);
    motion.acceleration.store_three(record.acceleration);
    record.since = now;
    record.tests = record.useless = 0;
    record.leapt = false;
}

// An object whose centre is outside its envelope has leapt. It probably moves on as before, so its envelope leaps with it. When
// a scene is set back or gets another origin, hardly any object needs a new prediction.
bool Predictor::leaps(ProxyStore &proxies, ProxyId id, Tick now)
{
    ProxyRecord &record = proxies.records[id];
    Place &place = proxies.places[id];
    const TightBox tight = place.tight_lanes(), before = place.envelope_lanes();
    const Float4 centre = middle_of_finite(tight), displacement = centre - load_three(record.position);
    const Mask4 outside = (centre < before.low) | (centre > before.high);
    if (!record.predicted || record.is_rounded || !is_finite(tight) || !(outside.bits() & three_lanes) ||
        !place.has_envelope())
        return false;
    place.set_envelope({before.low + displacement, before.high + displacement});
    if (!place.holds() || !place.has_end())
        return false;
    note_farthest(place.envelope_lanes());
    centre.store_three(record.position);
    record.since = now;
    record.tests = record.useless = 0;
    record.leapt = true;
    return true;
}

void Predictor::predict(Scene &scene, ProxyStore &proxies, const Origin &origin, const std::vector<ProxyId> &batch,
                        Tick now)
{
    constexpr std::size_t most = tuning::objects_per_call;
    seen_.resize(std::max(seen_.size(), std::min(most, batch.size())));
    for (std::size_t begin = 0; begin < batch.size(); begin += most)
    {
        const ProxyId *const some = batch.data() + begin;
        const std::size_t count = std::min(most, batch.size() - begin);
        for (std::size_t i = 0; i < count; ++i)
            prefetch(&proxies.records[some[i]]);
        ProxyId *end = ids_.data();
        for (std::size_t i = 0; i < count; ++i)
            if (!leaps(proxies, some[i], now))
                *end++ = some[i];
        const auto left = static_cast<std::size_t>(end - ids_.data());
        scene.observe(ids_.data(), left, seen_.data(), origin);
        for (std::size_t i = 0; i < left; ++i)
            predict(proxies, origin, ids_[i], seen_[i], now);
    }
}

void Predictor::note_tests(ProxyStore &proxies, const CandidatePair &pair)
{
    const bool apart = surely_apart(proxies.places[pair.first], proxies.places[pair.second]);
    for (ProxyId id : {pair.first, pair.second})
    {
        ++proxies.records[id].tests;
        proxies.records[id].useless += apart;
    }
}

Envelope Forecast::turning_on() const
{
    Envelope on = envelope;
    on.deviation.b += turning;
    return on;
}

Envelope Forecast::turned_anyhow() const
{
    Envelope anyhow = envelope;
    if (turning > 0)
    {
        anyhow.high = Vector3::Constant(farthest_corner(envelope));
        anyhow.low = -anyhow.high;
    }
    return anyhow;
}

Forecast Predictor::forecast(Scene &scene, const ProxyStore &proxies, ProxyId id, const QueryTime &now)
{
    Observation seen;
    scene.observe(&id, 1, &seen, Origin());
    const ProxyRecord &record = proxies.records[id];
    const Box bounds = scene.bounds(id);
    const SampledPose pose = scene.pose(id);
    const Vector3 pivot = finite_or_zero(pose.pivot);
    const Track *const track = samples_.ask(scene, proxies, id, now);
    Forecast forecast;
    Envelope &envelope = forecast.envelope;
    envelope.path.position = pivot;
    envelope.low = bounds.min() - pivot;
    envelope.high = bounds.max() - pivot;
    forecast.about_centre =
        seen.centre == pivot && std::isfinite(seen.radius); // with an offset, the centre circles around the pivot
    envelope.radius = forecast.about_centre ? seen.radius : farthest_corner(envelope);
    forecast.ticks = track ? 0 : std::numeric_limits<double>::infinity();
    forecast.turning = 0;
    if (track && track->is_known())
        follow(*track, record, forecast);
    return forecast;
}

// The motion of a hand is predicted more closely by a fit of its last positions than by the path through the last three.
void Predictor::follow(const Track &track, const ProxyRecord &record, Forecast &forecast) const
{
    Envelope &envelope = forecast.envelope;
    const Path path = record.role == Role::fixed_interactive ? track.fitted() : track.path();
    envelope.path.velocity = finite_or_zero(path.velocity);
    envelope.path.acceleration = finite_or_zero(path.acceleration);
    const double speed = envelope.path.velocity.norm(), bend = envelope.path.acceleration.norm();
    const float distance = tuning::forecast_reach * record.size;
    const float ticks = ticks_for(distance, static_cast<float>(speed), static_cast<float>(bend));
    forecast.ticks = ticks;
    const float travel = speed + bend > 0 ? distance : 0;
    envelope.deviation =
        deviation_of(record, adapted_deviation(record.size, record.spread, travel, ticks)) + track.rounding();
    const double turning = track.turning();
    forecast.turning = turning > 0 ? turning * farthest_corner(envelope) : 0; // 0 times infinity would be NaN
}
} // namespace ode_predictive_space
