#include "ode_predictive_space/broadphase/broadphase.h"

#include <algorithm>
#include <new>
#include <utility>

#include "ode_predictive_space/broadphase/near/contact_forecast.h"
#include "ode_predictive_space/broadphase/shape/gap.h"

namespace ode_predictive_space
{
// --- The tick -------------------------------------------------------------------------------------------------------------

void Broadphase::update(Scene &scene, bool is_tick)
{
    const Beginning beginning = begin(scene, is_tick);
    if (!beginning.needed)
        return;
    choose_mode(scene, beginning.time_passed);
    verify(scene, beginning); // broken, expired and requested predictions -> batch_
    if (has_work())
    {
        predict(scene); // batch_ -> paths and envelopes
        find_pairs();   // envelopes -> candidates_
        schedule();     // candidates_ and events that are due -> near_ and later events
        sweep(scene);   // all pairs, as long as not all objects are predicted
        finish_work();
    }
    finish();
}

std::size_t Broadphase::report(Scene &scene, std::vector<CandidatePair> &room)
{
    interrupted_ = true;
    const bool by_sweep = sweeping_.finds_pairs();
    const std::size_t most = by_sweep ? sweeping_.pairs() : near_.most_pairs();
    if (room.size() < most)
        room.resize(most);
    const CandidatePair *end = by_sweep                                  ? report_swept(scene, room.data())
                               : proximity_test_ == ProximityTest::shape ? report_by_shape(scene, room.data())
                                                                         : report_near(scene, room.data());
    interrupted_ = false;
    return static_cast<std::size_t>(end - room.data());
}

OverlapTest Broadphase::overlap_test(Scene &scene) const
{
    return {scene, boxes_.data(), proximity_test_ == ProximityTest::sphere};
}

CandidatePair *Broadphase::report_swept(Scene &scene, CandidatePair *room)
{
    return sweeping_.report(overlap_test(scene), proxies_.members(), room);
}

CandidatePair *Broadphase::report_near(Scene &scene, CandidatePair *room)
{
    boxes_.update(scene, near_.members(), proxies_.members());
    return near_.report(overlap_test(scene), now(), proxies_.count() > tuning::cached_boxes, room);
}

CandidatePair *Broadphase::report_by_shape(Scene &scene, CandidatePair *room)
{
    ShapeTest test({scene, proxies_.members(), boxes_, shapes_}, shape_margin_, counters_.looks);
    CandidatePair *end = near_.report_by_shape(test, now(), room);
    shapes_.clear_renewed();
    return end;
}

// --- Its steps ------------------------------------------------------------------------------------------------------------

Broadphase::Beginning Broadphase::begin(Scene &scene, bool is_tick)
{
    if (interrupted_)
        recover();
    const IdSet &moved = verifier_.collect_moves();
    idle_.drop_enabled(scene, [this](ProxyId id) { predictor_.request(id); });
    Beginning beginning;
    beginning.moves = moved.size();
    const Tick expected = clock_.expected();
    beginning.time_passed = clock_.advance(is_tick, beginning.moves > 0, moved, predictor_.moving());
    beginning.as_expected = now() == expected;
    beginning.needed = interrupted_ || beginning.moves > 0 || predictor_.has_requests();
    if (!beginning.needed)
        return beginning;
    interrupted_ = true;
    counters_.moved += beginning.moves;
    boxes_.invalidate(moved);
    shapes_.invalidate(moved);
    if (beginning.time_passed && mode() != Mode::sweeping)
        schedule_.advance(now());
    return beginning;
}

void Broadphase::choose_mode(Scene &scene, bool time_passed)
{
    if (mode() == Mode::sweeping)
    {
        if (!time_passed || !sweeping_.calm_returns(scene, proxies_.members(), predictor_.step_estimate))
            return;
        schedule_.restart(now());
        sweeping_.start_filling(proxies_.members(), proxies_.count());
    }
    else if (has_new_ && sweeping_.mostly_new(count_new(), proxies_.count()))
        start_sweeping(true);
}

void Broadphase::verify(Scene &scene, const Beginning &beginning)
{
    if (mode() == Mode::sweeping)
        return;
    const IdSet &moved = verifier_.moved();
    const Verifier::Outcome outcome =
        verifier_.find_broken(scene, proxies_, boxes_,
                              {now(), beginning.moves, beginning.time_passed, beginning.as_expected,
                               predictor_.moving(), sweeping_.waiting()},
                              batch_);
    counters_.verified += outcome.verified;
    counters_.violations += outcome.broken;
    if (predictor_.samples())
        predictor_.sample_moved(scene, proxies_, moved, now());
    near_.note_moves(moved);
    schedule_.take_expired(proxies_, batch_);
    predictor_.take_requests(batch_);
    const std::size_t predicted = proxies_.count() - sweeping_.waiting_count();
    if (beginning.time_passed && sweeping_.predictions_fail(outcome.broken, predicted))
        start_sweeping(false);
    else
    {
        idle_.note(scene, batch_.ids().data(), batch_.size());
        limit_batch(outcome.broken);
    }
}

// In most ticks of a small calm scene there is none.
bool Broadphase::has_work() const
{
    return !batch_.empty() || schedule_.has_due_events() || sweeping_.finds_pairs() || sweeping_.parts_joined();
}

// To predict many objects takes as long as several sweeps over all. When too many predictions broke, their objects wait; as
// long as some wait, a part of them is predicted in each tick.
void Broadphase::limit_batch(std::size_t broken)
{
    if (broken <= most_at_once())
    {
        if (mode() == Mode::filling)
            sweeping_.add_part(proxies_.count(), idle_.members(), batch_);
        return;
    }
    // What index, schedule and near set know of these objects is stale.
    for (ProxyId id : batch_.ids())
    {
        predictor_.forget_prediction(proxies_, id);
        ++proxies_.generations[id];
        sweeping_.wait(id);
    }
    batch_.clear();
}

void Broadphase::predict(Scene &scene)
{
    if (batch_.empty())
        return;
    for (ProxyId id : batch_.ids())
    {
        sweeping_.stop_waiting(id);
        near_.retire(id, now());
    }
    predictor_.predict(scene, proxies_, batch_, near_.members(), now());
    schedule_.expect_ends(proxies_, batch_, now());
    counters_.repredictions += batch_.size();
}

void Broadphase::find_pairs()
{
    if (!batch_.empty())
    {
        for (ProxyId id : batch_.ids())
            swept_.push_back({id, proxies_.swept_box(id, now())});
        index_.update(proxies_, swept_, batch_.members(), idle_.members(), now(), batch_.single(), candidates_);
    }
    if (sweeping_.take_parts_joined())
        index_.rebuild(proxies_, {}, idle_.members(), now());
}

void Broadphase::schedule()
{
    schedule_.classify(proxies_, candidates_, now(), proximity_test_, found_near_);
    counters_.woken += schedule_.wake(proxies_, now(), found_near_);
    for (const NearPair &pair : found_near_)
    {
        near_.add(pair);
        // The sphere test of proximity works on spheres throughout: tight boxes would not help.
        if (proximity_test_ == ProximityTest::sphere)
            continue;
        predictor_.note_neighbour(proxies_, pair.first);
        predictor_.note_neighbour(proxies_, pair.second);
    }
}

void Broadphase::sweep(Scene &scene)
{
    if (mode() == Mode::sweeping)
    {
        // Nothing is predicted; but objects that were found disabled are among the requests.
        predictor_.take_requests(batch_);
        idle_.note(scene, batch_.ids().data(), batch_.size());
    }
    else if (sweeping_.waiting_count() == 0)
        return;
    ++counters_.sweeps;
    const IdList &measured = boxes_.update(scene, proxies_.members(), proxies_.members());
    // A predicted object keeps its near pairs, and its place in the index, until it is predicted anew.
    idle_.note(scene, measured.data(), measured.size(), [this](ProxyId id) {
        if (proxies_.predicted(id))
            predictor_.request(id);
    });
    sweeping_.find_pairs(proxies_.members(), idle_.members(), boxes_);
}

void Broadphase::finish_work()
{
    sweeping_.finish_filling(batch_.size() < proxies_.count());
    schedule_.finish(proxies_);
    batch_.clear();
    clear_scratch(swept_);
    clear_scratch(candidates_);
    clear_scratch(found_near_);
}

void Broadphase::finish()
{
    verifier_.clear_moves();
    has_new_ = false;
    interrupted_ = false;
}

// --- Modes ----------------------------------------------------------------------------------------------------------------

// The one transition that is allowed in any state, also in one that an exception left: everything that was derived from
// positions is forgotten, and the next sweep finds all pairs.
void Broadphase::start_sweeping(bool with_new_objects)
{
    batch_.clear();
    swept_.clear();
    candidates_.clear();
    found_near_.clear();
    index_.clear(proxies_);
    schedule_.restart(now());
    near_.clear();
    predictor_.forget_predictions(proxies_);
    sweeping_.start(proxies_.members(), with_new_objects);
}

// After an exception.
void Broadphase::recover()
{
    resize_stages();
    start_sweeping(false);
}

void Broadphase::follow_shapes(Scene &scene, const IdSet &wanted)
{
    shapes_.renew_outdated(scene, wanted, proxies_.members());
    shapes_.update(scene, wanted, proxies_.members());
}

bool Broadphase::may_touch(ProxyId first, ProxyId second) const
{
    const ConvexShape &one = shapes_[first], &other = shapes_[second];
    const double margin = touching_distance(one, other, shape_margin_);
    return !(find_gap(one, other, Vector3::Zero(), margin).length > margin);
}

std::optional<double> Broadphase::time_of_contact(ProxyId first, ProxyId second) const
{
    const auto predicted = [this](ProxyId id) {
        const auto &kind = proxies_.records[id].kind;
        return PredictedShape{shapes_[id], proxies_.outer_envelope(id, now()), kind.still, kind.check == Check::centre};
    };
    const double duration = std::min(proxies_.remaining(first, now()), proxies_.remaining(second, now()));
    const double margin = touching_distance(shapes_[first], shapes_[second], shape_margin_);
    return ode_predictive_space::time_of_contact(predicted(first), predicted(second), margin, duration);
}

bool Broadphase::want_predictions()
{
    sweeping_.want_predictions();
    if (!sweeping_.end_for_predictions())
        return false;
    schedule_.restart(now());
    predictor_.request(proxies_.members());
    return true;
}

void Broadphase::predict_all_waiting()
{
    if (mode() == Mode::sweeping)
    {
        schedule_.restart(now());
        sweeping_.start_filling(proxies_.members(), proxies_.count());
    }
    predictor_.request(sweeping_.waiting());
}

std::size_t Broadphase::count_new() const
{
    std::size_t count = 0;
    verifier_.moved().for_each([&](ProxyId id) { count += !proxies_.predicted(id) && !sweeping_.waits(id); });
    return count;
}

// A small scene is predicted as a whole.
std::size_t Broadphase::most_at_once() const
{
    const std::size_t objects = proxies_.count();
    return objects <= tuning::small_scene ? tuning::small_scene
                                          : std::max(tuning::least_at_once, objects / tuning::part_at_once);
}

// --- Objects --------------------------------------------------------------------------------------------------------------

void Broadphase::make_room()
{
    const std::size_t size = proxies_.size();
    proxies_.make_room();
    if (proxies_.size() == size && !interrupted_)
        return;
    const bool was_interrupted = std::exchange(interrupted_, true);
    resize_stages();
    interrupted_ = was_interrupted;
}

ProxyId Broadphase::add()
{
    make_room();
    const ProxyId id = proxies_.add();
    if (proxies_.count() >= tuning::least_trimmed)
        trim_below_ = std::max(trim_below_, proxies_.count() / 4);
    has_new_ = true;
    mark_moved(id);
    return id;
}

// ODE removes geoms in their destructors. When memory runs out here, the next update recovers.
void Broadphase::remove(ProxyId id)
{
    verifier_.forget(id);
    idle_.forget(id);
    shapes_.forget(id);
    try
    {
        if (!interrupted_)
            forget(id);
    }
    catch (const std::bad_alloc &)
    {
        interrupted_ = true;
    }
    sweeping_.stop_waiting(id);
    proxies_.remove(id);
    sweeping_.finish_filling(true);
    if (proxies_.count() < trim_below_)
        trim();
}

// What was derived from the old generation is stale from now on.
void Broadphase::forget(ProxyId id)
{
    near_.retire(id, now());
    index_.remove(proxies_, id);
    predictor_.forget(proxies_, id);
}

void Broadphase::resize_stages()
{
    const std::size_t size = proxies_.size();
    boxes_.resize(size);
    shapes_.resize(size);
    idle_.resize(size);
    verifier_.resize(size);
    predictor_.resize(size);
    near_.resize(size);
    sweeping_.resize(size);
    batch_.resize(size);
}

// Most objects are gone. What is known of the others is given up with the memory: it is soon found again. Throws nothing.
void Broadphase::trim()
{
    const std::size_t size = proxies_.size();
    trim_below_ = (proxies_.count() + 1) / 2; // also when the last one is removed
    if (2 * proxies_.needed_size() > size)
        return;
    start_sweeping(true);
    proxies_.trim();
    predictor_.forget_histories(proxies_);
    index_ = {};
    schedule_.release(now());
    near_.release();
    sweeping_.release();
    batch_ = {};
    free_memory(swept_);
    free_memory(candidates_);
    free_memory(found_near_);
    resize_stages();
}

// --- Settings and numbers -------------------------------------------------------------------------------------------------

void Broadphase::set_proximity_test(ProximityTest test)
{
    if (test != ProximityTest::shape)
        shapes_.stop();
    else if (!shapes_.in_use())
        shapes_.start(proxies_.size());
    proximity_test_ = test;
    near_.restart_tests();
    predictor_.settings_changed(proxies_);
}

void Broadphase::set_shape_margin(double margin)
{
    shape_margin_ = margin;
    near_.restart_tests();
}

void Broadphase::set_settings(const PredictionSettings &settings)
{
    predictor_.settings = settings;
    predictor_.settings_changed(proxies_);
}

std::size_t Broadphase::near_pairs() const
{
    std::size_t count = 0;
    for_each_near_pair([&](const CandidatePair &, PairState) { ++count; });
    return count;
}

std::size_t Broadphase::postponed_pairs() const
{
    std::size_t count = 0;
    if (!sweeping_.finds_pairs())
        near_.for_each_postponed(shapes_, [&](const CandidatePair &) { ++count; });
    return count;
}

std::size_t Broadphase::bytes() const
{
    return proxies_.bytes() + boxes_.bytes() + shapes_.bytes() + idle_.bytes() + verifier_.bytes() +
           predictor_.bytes() + index_.bytes() + schedule_.bytes() + near_.bytes() + sweeping_.bytes() +
           batch_.bytes() + bytes_of(swept_) + bytes_of(candidates_) + bytes_of(found_near_);
}
} // namespace ode_predictive_space
