#include "ode_predictive_space/broadphase/broadphase.h"

#include <algorithm>
#include <utility>

namespace ode_predictive_space
{
namespace
{
// Keeps the memory for the next tick, unless it was made for an exceptional one.
template <typename T> void empty(std::vector<T> &scratch)
{
    constexpr std::size_t small = 1024;
    if (scratch.capacity() > small && scratch.size() < scratch.capacity() / 8)
        scratch = std::vector<T>();
    scratch.clear();
}
} // namespace

// The first tick of a small scene should not spend its time on growing vectors.
Broadphase::Broadphase()
{
    constexpr std::size_t few = 128;
    suspects_.reserve(few);
    items_.reserve(few);
    candidates_.reserve(few);
    scanned_.reserve(few);
    near_.reserve(few);
}

ProxyId Broadphase::add()
{
    ProxyId id;
    if (!free_ids_.empty())
    {
        id = free_ids_.back();
        free_ids_.pop_back();
    }
    else
    {
        id = static_cast<ProxyId>(proxies_.size());
        proxies_.grow();
        grow(boxes_, proxies_.size());
        for (IdSet *set : {&members_, &moved_, &doubtful_, &moving_, &in_batch_, &interactive_, &due_anew_, &waiting_,
                           &measured_, &stirred_})
            set->resize(proxies_.size());
        noticed_.resize(proxies_.size());
        near_.resize(proxies_.size());
    }
    proxies_.forget(id);
    members_.insert(id);
    ++objects_;
    ++unpredicted_;
    mark_moved(id);
    return id;
}

void Broadphase::remove(ProxyId id)
{
    // Whatever speaks of the old generation, in near set, schedule or elsewhere, is stale from now on.
    ++proxies_.generations[id];
    near_.retire(id, now_);
    unpredicted_ -= proxies_.bounds[id].check == Check::none;
    index_.remove(proxies_, id);
    predictor.forget(proxies_, id);
    sample(id, false);
    noticed_.erase(id);
    for (IdSet *set : {&members_, &moved_, &doubtful_, &moving_, &interactive_, &due_anew_})
        set->erase(id);
    free_ids_.push_back(id);
    --objects_;
    if (stop_waiting(id) && !scanning())
        finish_parts();
}

void Broadphase::set_role(ProxyId id, Role role)
{
    proxies_.bounds[id].role = role;
    if (!is_interactive(role))
        sample(id, false);
    due_anew_.insert(id);
}

void Broadphase::set_measure(Proximity measure)
{
    measure_ = measure;
    predict_all_anew();
}

void Broadphase::predict_all_anew()
{
    members_.for_each([&](ProxyId id) {
        std::uint32_t &horizon = proxies_.bounds[id].horizon;
        if (horizon != 0)
            horizon = std::clamp(horizon, predictor.horizon.min_ticks, predictor.horizon.max_ticks);
        due_anew_.insert(id);
    });
}

// While nothing moves, no time passes. A program that asks between its steps and its ticks is told by what the majority
// of the moving objects did.
bool Broadphase::time_passes(bool is_tick)
{
    const bool passes = !moved_.empty() && ((is_tick && !ticked_early_) || most_moving_have_moved());
    ticked_early_ = !is_tick && (ticked_early_ || passes);
    next_tick_ = now_ + (passes ? 1 : 0) + (ticked_early_ ? 0 : 1);
    return passes;
}

bool Broadphase::most_moving_have_moved() const
{
    std::size_t moving = 0, moved = 0;
    for (std::size_t i = 0; i < moved_.words(); ++i)
    {
        moving += IdSet::count(moving_.word(i));
        moved += IdSet::count(moving_.word(i) & moved_.word(i));
    }
    return moving > 0 && 2 * moved >= moving;
}

void Broadphase::advance_clock()
{
    ++now_;
    if (now_ % ticks_per_count == 0)
        gather_predictions();
    if (!policy_.scanning())
        wheel_.advance(now_, due_);
}

// Where only a few objects are predicted per tick, several ticks' predictions are made at once; no tick is to have many.
void Broadphase::gather_predictions()
{
    constexpr std::uint32_t most_ticks = 8;
    constexpr std::uint64_t some = 8;
    const std::uint64_t made = counters_.repredictions - counted_predictions_;
    counted_predictions_ = counters_.repredictions;
    predictor.gather = most_ticks;
    while (predictor.gather > 1 && predictor.gather * made > some * ticks_per_count)
        predictor.gather /= 2;
}

// Those of which the notice of their move left doubt, and those that were predicted to move and did not: they have left
// their path, and nobody reports that. When it is not the tick by which the notices were judged, all that moved.
void Broadphase::collect_suspects(bool time_passes, bool as_expected)
{
    auto collect = [this](ProxyId id) { suspects_.push_back(id); };
    for (std::size_t i = 0; i < moved_.words(); ++i)
    {
        const std::uint64_t predicted = ~waiting_.word(i), moved = moved_.word(i) & predicted;
        const std::uint64_t stopped = time_passes ? moving_.word(i) & ~moved : 0;
        counters_.verified += IdSet::count(moved | stopped);
        IdSet::visit_word(i, (as_expected ? doubtful_.word(i) & predicted : moved) | stopped, collect);
    }
}

// Is an object that is still within its envelope, although nobody reports a move of it, to be predicted to stay there? It
// may have missed one tick only; a prediction costs as much as some tens of looks, so one look in as many decides.
bool Broadphase::has_stopped(ProxyId id) const
{
    constexpr Tick looks_per_prediction = 32;
    return !moved_.contains(id) && (now_ + id) % looks_per_prediction == 0;
}

void Broadphase::add_to_batch(ProxyId id)
{
    if (in_batch_.contains(id))
        return;
    in_batch_.insert(id);
    batch_.push_back(id);
}

void Broadphase::sample(ProxyId id, bool wanted)
{
    if (wanted == interactive_.contains(id))
        return;
    if (wanted)
        interactive_.insert(id);
    else
        interactive_.erase(id);
    sampled_ = interactive_.size();
}

// Those whose horizon ends, and those that are to be predicted anew for another reason, join those that broke theirs.
void Broadphase::expire()
{
    for (const Event &event : due_)
        if (event.second == no_proxy && current(event))
            add_to_batch(event.first);
    if (due_anew_.empty())
        return;
    due_anew_.for_each([this](ProxyId id) { add_to_batch(id); });
    due_anew_.clear();
}

// @param single see EnvelopeIndex::update().
void Broadphase::find_pairs(std::size_t single)
{
    for (ProxyId id : batch_)
        swept_.push_back({id, proxies_.swept_box(id, now_)});
    index_.update(proxies_, swept_, in_batch_, now_, single, candidates_);
    if (std::exchange(parts_joined_, false))
        index_.rebuild(proxies_, {}, now_);
}

void Broadphase::schedule()
{
    assess(proxies_, candidates_, now_, measure_, found_near_, scheduled_);
    for (const ScheduledPair &pair : scheduled_)
        wheel_.schedule(now_ + static_cast<Tick>(pair.ticks), pair.event);
    for (const NearPair &pair : found_near_)
        add_near(pair);
}

void Broadphase::add_near(const NearPair &pair)
{
    near_.add(pair);
    note_crowded(pair);
}

// Pairs whose time has come, unless a newer prediction of either object has dealt with them.
void Broadphase::wake()
{
    for (const Event &event : due_)
    {
        if (event.second == no_proxy || !current(event))
            continue;
        add_near(NearPair::of(event, now_));
        ++counters_.woken;
    }
}

// An object that will stay near others for long is worth tight bounds; it gets them with its next prediction, which is due
// at once. The paper's measure works on spheres throughout.
void Broadphase::note_crowded(const NearPair &pair)
{
    if (measure_ == Proximity::sphere)
        return;
    for (ProxyId id : {pair.first, pair.second})
    {
        PackedBounds &bounds = proxies_.bounds[id];
        if (bounds.check == Check::centre && !bounds.crowded && bounds.tight_bounds_last && lingers(id))
        {
            bounds.crowded = true;
            due_anew_.insert(id);
        }
    }
}

// Does it take many ticks to move by its own size?
bool Broadphase::lingers(ProxyId id) const
{
    constexpr double many = 600;
    return many * proxies_.paths[id].path().velocity.lpNorm<Eigen::Infinity>() < proxies_.bounds[id].radius;
}

void Broadphase::finish_update()
{
    for (ProxyId id : batch_)
        in_batch_.erase(id);
    empty(batch_);
    empty(swept_);
    empty(due_);
    empty(candidates_);
    empty(scheduled_);
    empty(found_near_);
    purge_stale_events();
}

bool Broadphase::current(const Event &event) const
{
    return proxies_.current(event.first, event.first_generation) &&
           (event.second == no_proxy || proxies_.current(event.second, event.second_generation));
}

std::size_t Broadphase::scheduled_pairs() const
{
    std::size_t count = 0;
    wheel_.for_each([&](const Event &event) { count += event.second != no_proxy && current(event); });
    return count;
}

std::size_t Broadphase::near_pairs() const
{
    std::size_t count = 0;
    each_near([&](const CandidatePair &, NearSet::Verdict) { ++count; });
    return count;
}

// Stale events wait for their tick. Where many predictions break early they would pile up.
void Broadphase::purge_stale_events()
{
    if (wheel_.size() < purge_events_at_)
        return;
    wheel_.purge([this](const Event &event) { return current(event); });
    purge_events_at_ = std::max(least_purge, 2 * wheel_.size());
}

void Broadphase::take_note_of_moves()
{
    near_.disturb(moved_);
    stirred_ |= moved_;
    moved_.clear();
    doubtful_.clear();
}

bool Broadphase::want_predictions()
{
    predictions_wanted_ = true;
    if (!policy_.at_beginning())
        return false;
    policy_.end();
    wheel_.restart(now_);
    release_scan();
    predict_all_anew();
    return true;
}

void Broadphase::predict_the_rest()
{
    if (policy_.scanning())
    {
        policy_.end();
        stop_scanning();
    }
    due_anew_ |= waiting_;
}

// More have left their paths than can be predicted in a tick: from now on all are swept, until each had its turn. Where they
// are in index, schedule and near set, they are stale.
void Broadphase::postpone_batch()
{
    for (ProxyId id : batch_)
    {
        unpredicted_ += proxies_.bounds[id].check != Check::none;
        proxies_.forget_prediction(id);
        ++proxies_.generations[id];
        moving_.erase(id);
        sample(id, false);
        in_batch_.erase(id);
        waiting_count_ += !waiting_.contains(id);
        waiting_.insert(id);
    }
    batch_.clear();
}

bool Broadphase::stop_waiting(ProxyId id)
{
    if (!is_waiting(id))
        return false;
    waiting_.erase(id);
    --waiting_count_;
    return true;
}

// Some that lie side by side, as the last sweep found them: they make a good part of a tree. Who was not there yet has a
// place in the next queue.
void Broadphase::add_part()
{
    if (queue_.empty())
        sweep_.sort_along_widest(items_, queue_);
    for (std::size_t room = part(); room > 0 && !queue_.empty(); queue_.pop_back())
        if (is_waiting(queue_.back()))
        {
            add_to_batch(queue_.back());
            --room;
        }
}

// A tree made of parts is not as good as one that is built at once; that is left to the next tick, which sweeps nothing.
void Broadphase::finish_parts()
{
    release_scan();
    parts_joined_ = batch_.size() < objects();
}

void Broadphase::start_scanning()
{
    finish_update();
    index_.clear(proxies_);
    wheel_.clear();
    near_.clear();
    due_anew_.clear();
    moving_.clear();
    // Nobody is remembered meanwhile: what is remembered of an object depends on how it is predicted.
    interactive_.clear();
    sampled_ = 0;
    waiting_.clear();
    waiting_count_ = 0;
    scouts_.choose(members_);
    if (unpredicted_ < objects())
        members_.for_each([this](ProxyId id) { proxies_.forget_prediction(id); });
    unpredicted_ = objects();
    moved_ |= members_;
}

// From now on all are swept only until each had its turn to be predicted.
void Broadphase::stop_scanning()
{
    wheel_.restart(now_);
    waiting_ = members_;
    waiting_count_ = objects();
}

void Broadphase::release_scan()
{
    items_ = {};
    sweep_ = {};
    scanned_ = {};
    queue_ = {};
}

std::size_t Broadphase::bytes() const
{
    std::size_t total = proxies_.bytes() + predictor.bytes() + index_.bytes() + wheel_.bytes() + sweep_.bytes();
    for (const IdSet *set : {&members_, &moved_, &doubtful_, &moving_, &in_batch_, &interactive_, &due_anew_, &waiting_,
                             &measured_, &stirred_})
        total += set->bytes();
    total += noticed_.bytes();
    total += (free_ids_.capacity() + suspects_.capacity() + batch_.capacity() + queue_.capacity()) * sizeof(ProxyId);
    total += swept_.capacity() * sizeof(SweptProxy);
    total += near_.bytes() + found_near_.capacity() * sizeof(NearPair) + due_.capacity() * sizeof(Event);
    total += candidates_.capacity() * sizeof(CandidatePair) + scheduled_.capacity() * sizeof(ScheduledPair);
    total += scouts_.bytes() + scanned_.capacity() * sizeof(CandidatePair);
    return total + items_.capacity() * sizeof(SweptProxy) + boxes_.capacity() * sizeof(MeasuredBox);
}
} // namespace ode_predictive_space
