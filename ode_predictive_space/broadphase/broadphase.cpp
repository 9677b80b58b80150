#include "ode_predictive_space/broadphase/broadphase.h"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "ode_predictive_space/broadphase/near/contact_forecast.h"
#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/prediction/proximity.h"

namespace ode_predictive_space
{
// --- The tick -------------------------------------------------------------------------------------------------------------

void Broadphase::update(Scene &scene, bool is_tick)
{
    // Starting over renews the update numbers of all objects before the wrap-around could make an old number a later one.
    constexpr UpdateNumber half_of_all = Place::last_update / 2 + 1;
    if (next_origin_)
        move_origin(*next_origin_);
    if (interrupted_ || clock_.update % half_of_all == 0)
        start_over();
    request_enabled(scene);
    clock_.unticked += clock_.moves;
    clock_.queries = is_tick ? 0 : clock_.queries + (clock_.moves > 0);
    const bool only_queries = clock_.queries > tuning::calls_of_a_habit && clock_.moves > 0;
    const bool time_passes = clock_.unticked > 0 && (is_tick || only_queries);
    if (listing_.listed.empty() && !listing_.any_doubtful && clock_.moves == 0 && !time_passes &&
        !near_.has_retired() && pairing_.waiting.empty())
        return;
    interrupted_ = true;
    counters_.moved += clock_.moves;
    clock_.moves = 0;
    if (time_passes)
    {
        ++clock_.now;
        clock_.unticked = 0;
        predictor_.sample(scene, proxies_, clock_.now);
    }
    measure_listed(scene); // listed objects -> batch_
    near_.drop_retired([this](const CandidatePair &pair) { Predictor::note_tests(proxies_, pair); });
    if (!batch_.empty())
        predict(scene); // batch_ -> envelopes
    if (is_tick)
        find_pairs(scene); // batch_, pairing_.waiting -> near_
    else
        postpone_pairs(); // batch_ -> pairing_.waiting
    index_.put(proxies_, batch_);
    if (time_passes)
        review(scene);
    finish();
}

void Broadphase::find_new_pairs(Scene &scene)
{
    catch_up(scene);
    interrupted_ = true;
    find_pairs(scene);
    interrupted_ = false; // not finish(): the update number must not advance
}

// ODE enables geoms without notice, so the disabled ones are polled.
void Broadphase::request_enabled(Scene &scene)
{
    if (idle_.empty())
        return;
    clear_scratch(listing_.current);
    idle_.for_each([this](ProxyId id) { listing_.current.push_back(id); });
    idle_.clear();
    scene.find_disabled(listing_.current, idle_);
    for (ProxyId id : listing_.current)
        if (!idle_.contains(id))
            request(id);
}

// Objects that are outside their envelopes, or have boundless ones, or are requested, join the batch.
void Broadphase::measure_listed(Scene &scene)
{
    if (listing_.listed.empty())
        return;
    clear_scratch(listing_.current);
    listing_.listed.for_each([this](ProxyId id) {
        if (!proxies_.places[id].watches_solid())
            listing_.current.push_back(id);
    });
    scene.measure(listing_.current.data(), listing_.current.size(), proxies_.places.data(), origin_);
    listing_.listed.for_each([this](ProxyId id) {
        Place &place = proxies_.places[id];
        place.note_doubtful_move(clock_.update);
#ifdef ODE_PREDICTIVE_SPACE_WITHOUT_VERIFY
        // For the test which shows that the differential test fails when predictions are not verified.
        const bool holds = place.has_envelope();
#else
        const bool holds = place.holds() && !place.is_boundless();
#endif
        counters_.violations += !holds && place.has_envelope();
        const bool is_requested = listing_.requested.contains(id);
        if (holds && !is_requested)
            return near_.disturb(id);
        if (is_requested)
            place.forget_envelope(); // prevents a leap, so that it gets a new one
        near_.retire(id);
        batch_.add(id);
    });
    listing_.listed.clear();
    listing_.requested.clear();
}

void Broadphase::predict(Scene &scene)
{
    predictor_.predict(scene, proxies_, origin_, batch_.ids(), clock_.now);
    scene.find_disabled(batch_.ids(), idle_);
    counters_.repredictions += batch_.size();
}

void Broadphase::postpone_pairs()
{
    for (ProxyId id : batch_.ids())
        pairing_.waiting.insert(id);
}

void Broadphase::find_pairs(Scene &scene)
{
    if (pairing_.waiting.empty())
        return find_pairs(scene, batch_);
    postpone_pairs();
    pairing_.waiting.for_each([this](ProxyId id) { pairing_.batch.add(id); });
    find_pairs(scene, pairing_.batch);
    pairing_.waiting.clear();
    pairing_.batch.clear();
}

void Broadphase::find_pairs(Scene &scene, const Batch &batch)
{
    if (batch.empty())
        return;
    counters_.sweeps += !index_.find_pairs(proxies_, batch, idle_, pairing_.found);
    make_tight(scene, batch);
    const bool by_shape = proximity_test_ == ProximityTest::shape;
    for (const CandidatePair &pair : pairing_.found)
        if (!envelopes_apart(proxies_.places[pair.first], proxies_.places[pair.second]))
            near_.add(pair, by_shape && proxies_.is_checked_by_shape(pair.first, pair.second));
    clear_scratch(pairing_.found);
}

// Objects whose envelopes meet are watched by their tight boxes. New envelopes shrink from bounding spheres to these boxes.
void Broadphase::make_tight(Scene &scene, const Batch &batch)
{
    clear_scratch(listing_.current);
    for (const CandidatePair &pair : pairing_.found)
        for (ProxyId id : {pair.first, pair.second})
            if (Place &place = proxies_.places[id]; place.watches_centre())
            {
                place.stop_watching();
                listing_.current.push_back(id);
            }
    if (listing_.current.empty())
        return;
    scene.measure(listing_.current.data(), listing_.current.size(), proxies_.places.data(), origin_);
    for (ProxyId id : listing_.current)
        if (batch.contains(id))
            proxies_.places[id].tighten(proxies_.records[id].radius);
}

void Broadphase::finish()
{
    batch_.clear();
    listing_.any_doubtful = false;
    clock_.update = (clock_.update + 1) & Place::last_update;
    interrupted_ = false;
}

std::size_t Broadphase::report(Scene &scene, std::vector<CandidatePair> &room)
{
    interrupted_ = true;
    if (room.size() < near_.most_pairs())
        room.resize(near_.most_pairs());
    const UpdateNumber last = (clock_.update - 1) & Place::last_update;
    const bool by_sphere = proximity_test_ == ProximityTest::sphere;
    const float certain = by_sphere ? std::numeric_limits<float>::infinity() : Place::rounding * predictor_.farthest();
    const Float4 doubt = origin_.doubt();
    const OverlapTest test{scene, proxies_.places.data(), by_sphere, doubt,
                           Float4::all(certain) + Float4::all(Place::most_doubts) * doubt};
    std::optional<ShapeTest> by_shape;
    if (proximity_test_ == ProximityTest::shape)
        by_shape.emplace(ShapeTest{test, proxies_, shapes_, shape_margin_, counters_.gap_checks});
    CandidatePair *end = near_.report(test, by_shape, last, room.data());
    shapes_.clear_renewed();
    interrupted_ = false;
    return static_cast<std::size_t>(end - room.data());
}

// Discards everything derived from positions; the next measure finds it again. Valid in any state, also after an exception.
void Broadphase::start_over()
{
    resize_stages();
    batch_.clear();
    pairing_.batch.clear();
    pairing_.waiting.clear();
    pairing_.found.clear();
    index_.clear(proxies_);
    near_.clear();
    if (shapes_.in_use())
        shapes_.start(proxies_.size());
    proxies_.members().for_each([this](ProxyId id) {
        proxies_.places[id].forget_envelope();
        list(id);
    });
}

// When all objects are far from the origin, rounding enlarges their boxes, so the next update moves it near them.
void Broadphase::review(Scene &scene)
{
    const std::optional<Vector3> middle = predictor_.review(proxies_);
    if (middle && scene.is_in_double_precision())
        next_origin_ = origin_.place() + *middle;
}

// Stored coordinates are relative to the old origin, so the update starts over and predicts all objects as new ones.
void Broadphase::move_origin(const Vector3 &origin)
{
    interrupted_ = true;
    origin_ = Origin(origin);
    next_origin_.reset();
    proxies_.members().for_each([this](ProxyId id) { proxies_.records[id].predicted = false; });
    predictor_.forget_reviews();
}

// The later of two times until which two objects are apart; none if either is none, as then they stay apart.
static std::optional<double> later(std::optional<double> one, std::optional<double> other)
{
    return one && other ? std::max(one, other) : std::nullopt;
}

// --- Queries --------------------------------------------------------------------------------------------------------------

Forecast Broadphase::forecast(Scene &scene, ProxyId id, std::uint64_t collisions)
{
    return predictor_.forecast(scene, proxies_, id, {clock_.now + (clock_.unticked > 0), collisions});
}

std::optional<double> Broadphase::time_of_proximity(const Forecast &first, const Forecast &second, bool by_sphere) const
{
    const double ticks = std::min(first.ticks, second.ticks);
    const double duration = std::isfinite(ticks) ? ticks : 0;
    const auto earliest = [&](TimeOfProximity &time, const Envelope &one, const Envelope &other) {
        return time_in_halves(time, one, other, duration, tuning::forecast_halvings);
    };
    std::optional<double> time = earliest(box_time_of_proximity, first.turning_on(), second.turning_on());
    if (time && first.turning + second.turning > 0)
        time = later(time, earliest(box_time_of_proximity, first.turned_anyhow(), second.turned_anyhow()));
    if (time && by_sphere && first.about_centre && second.about_centre)
        time = later(time, earliest(sphere_time_of_proximity, first.envelope, second.envelope));
    return time;
}

void Broadphase::follow_shapes(Scene &scene, const IdSet &wanted)
{
    interrupted_ = true;
    shapes_.update(scene, wanted, proxies_);
    interrupted_ = false;
}

bool Broadphase::may_touch(const CandidatePair &pair) const
{
    return shapes_may_touch(shapes_[pair.first], shapes_[pair.second], shape_margin_);
}

std::optional<double> Broadphase::time_of_contact(const Forecast &first, const Forecast &second,
                                                  const CandidatePair &pair) const
{
    const ConvexShape &one = shapes_[pair.first], &other = shapes_[pair.second];
    const auto earliest = [&](const PredictedShape &shape, const PredictedShape &other_shape) {
        return ode_predictive_space::time_of_contact(shape, other_shape, touching_distance(one, other, shape_margin_),
                                                     std::min(first.ticks, second.ticks));
    };
    const auto turning_on = [](const ConvexShape &shape, const Forecast &forecast) {
        return PredictedShape{shape, forecast.turning_on(), forecast.still(), forecast.about_centre, false};
    };
    const auto turned_anyhow = [](const ConvexShape &shape, const Forecast &forecast) {
        return PredictedShape{shape, forecast.envelope, forecast.still(), forecast.about_centre, forecast.turning > 0};
    };
    const std::optional<double> time = earliest(turning_on(one, first), turning_on(other, second));
    if (!time || first.turning + second.turning == 0)
        return time;
    return later(time, earliest(turned_anyhow(one, first), turned_anyhow(other, second)));
}

// --- Objects --------------------------------------------------------------------------------------------------------------

void Broadphase::make_room(std::size_t more)
{
    const std::size_t size = proxies_.size();
    proxies_.make_room(more);
    if (proxies_.size() == size && !interrupted_)
        return;
    const bool was_interrupted = std::exchange(interrupted_, true);
    resize_stages();
    interrupted_ = was_interrupted;
}

ProxyId Broadphase::add()
{
    make_room(1);
    const ProxyId id = proxies_.add();
    if (proxies_.count() >= tuning::kept_elements)
        trim_below_ = std::max(trim_below_, proxies_.count() / 4);
    mark_moved(id);
    return id;
}

// ODE removes geoms in destructors, so nothing may be thrown.
void Broadphase::remove(ProxyId id)
{
    listing_.listed.erase(id);
    listing_.requested.erase(id);
    pairing_.waiting.erase(id);
    idle_.erase(id);
    shapes_.forget(id);
    predictor_.forget(id);
    near_.close_account(id);
    if (!interrupted_)
    {
        near_.retire(id);
        index_.remove(proxies_, id);
    }
    proxies_.remove(id);
    if (proxies_.count() < trim_below_)
        trim();
}

void Broadphase::resize_stages()
{
    const std::size_t size = proxies_.size();
    shapes_.resize(size);
    idle_.resize(size);
    near_.resize(size);
    batch_.resize(size);
    pairing_.batch.resize(size);
    pairing_.waiting.resize(size);
    listing_.listed.resize(size);
    listing_.requested.resize(size);
}

// Gives memory back after most objects were removed. The next update starts over, because the derived state goes with it.
void Broadphase::trim()
{
    const std::size_t size = proxies_.size();
    trim_below_ = (proxies_.count() + 1) / 2; // rounded up, so that removing the last object trims, too
    if (2 * proxies_.needed_size() > size)
        return;
    interrupted_ = true;
    proxies_.trim();
    predictor_.release();
    index_ = {};
    near_.clear();
    batch_ = {};
    pairing_.batch = {};
    free_memory(listing_.current);
    free_memory(pairing_.found);
    try
    {
        resize_stages();
    }
    catch (const std::bad_alloc &)
    { // start_over() tries again
    }
}

// --- Settings and numbers -------------------------------------------------------------------------------------------------

void Broadphase::request_all()
{
    proxies_.members().for_each([this](ProxyId id) { request(id); });
}

void Broadphase::set_proximity_test(ProximityTest test)
{
    if (test != ProximityTest::shape)
        shapes_.stop();
    else if (!shapes_.in_use())
        shapes_.start(proxies_.size());
    proximity_test_ = test;
    interrupted_ = true; // pair states belong to the former test
}

void Broadphase::set_shape_margin(double margin)
{
    shape_margin_ = margin;
    interrupted_ = true; // pair states belong to the former margin
}

void Broadphase::set_settings(const PredictionSettings &settings)
{
    predictor_.settings = settings;
    request_all();
}

void Broadphase::set_role(ProxyId id, Role role)
{
    proxies_.set_role(id, role);
    request(id);
}

std::size_t Broadphase::near_pairs() const
{
    std::size_t count = 0;
    near_.for_each([&](const CandidatePair &, PairState) { ++count; });
    return count;
}

std::size_t Broadphase::postponed_pairs() const
{
    std::size_t count = 0;
    near_.for_each_postponed(shapes_, [&](const CandidatePair &) { ++count; });
    return count;
}

std::size_t Broadphase::bytes() const
{
    return proxies_.bytes() + shapes_.bytes() + idle_.bytes() + predictor_.bytes() + index_.bytes() + near_.bytes() +
           bytes_of(listing_.current) + batch_.bytes() + pairing_.batch.bytes() + pairing_.waiting.bytes() +
           listing_.listed.bytes() + listing_.requested.bytes() + bytes_of(pairing_.found);
}
} // namespace ode_predictive_space
