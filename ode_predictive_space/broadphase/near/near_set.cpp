#include "ode_predictive_space/broadphase/near/near_set.h"

#include <algorithm>

#include "ode_predictive_space/broadphase/base/prefetch.h"

namespace ode_predictive_space
{
namespace
{
// For pairs beside which nothing is kept.
constexpr auto keep_nothing = [](std::size_t, std::size_t) {};

// Moves what is kept beside pairs when the pairs are moved.
auto keep_beside(std::vector<Look> &looks)
{
    return [&looks](std::size_t from, std::size_t to) { looks[to] = looks[from]; };
}
} // namespace

CandidatePair *NearSet::report(const OverlapTest &test, Tick now, bool prefetches, CandidatePair *room)
{
    activate_disturbed();
    CandidatePair *end = visit_active(test.boxes, now, prefetches, OverlapCollector(test, room)).end();
    end = std::copy(overlapping_.begin(), overlapping_.end(), end);
    if (++reports_ % tuning::reports_per_rest == 0)
        let_rest([&](std::size_t i) { return test(pairs_[i]); }, keep_nothing);
    return end;
}

CandidatePair *NearSet::report_by_shape(ShapeTest &test, Tick now, CandidatePair *room)
{
    activate_disturbed();
    looks_.resize(pairs_.size());
    if (may_have_stale(now))
        drop_stale(now);
    follow_postponed(test);
    find_open(test);
    CandidatePair *end = room;
    for (std::uint32_t i : open_)
    {
        *end = pairs_[i];
        end += looks_[i].pause > 0 ? looks_[i].pause-- > 0 : test.may_touch(pairs_[i], looks_[i]);
    }
    end = std::copy(overlapping_.begin(), overlapping_.end(), end);
    if (++reports_ % tuning::reports_per_rest == 0)
    {
        let_rest(
            [&](std::size_t i) {
                return looks_[i].due == 0 && test.boxes_overlap(pairs_[i]) && test.may_touch(pairs_[i], looks_[i]);
            },
            keep_beside(looks_));
        test.keep_only(members_);
    }
    return end;
}

// Brings the travels of postponed pairs up to date. A pair of an object whose shape is another one now is as good as new, also one
// at rest: a hull may change without a move.
void NearSet::follow_postponed(ShapeTest &test)
{
    wanted_.clear();
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        if (looks_[i].due > 0)
            want(pairs_[i]);
    test.renew_outdated(members_);
    test.follow(wanted_);
    if (!test.shapes().any_renewed())
        return;
    note_moves(test.shapes().renewed());
    activate_disturbed();
    looks_.resize(pairs_.size());
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        if (test.shapes().renewed(pairs_[i]))
            looks_[i] = {};
}

// The pairs that are not postponed and whose boxes overlap -> open_. Their shapes are up to date where they are looked at.
void NearSet::find_open(ShapeTest &test)
{
    wanted_.clear();
    open_.clear();
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        if (!test.postpones(pairs_[i], looks_[i]))
        {
            looks_[i].due = 0;
            open_.push_back(static_cast<std::uint32_t>(i));
            want(pairs_[i]);
        }
    test.measure(wanted_);
    wanted_.clear();
    std::uint32_t *left = open_.data();
    for (std::uint32_t i : open_)
        if (test.boxes_overlap(pairs_[i]))
        {
            *left++ = i;
            if (looks_[i].pause == 0)
                want(pairs_[i]);
        }
    open_.resize(static_cast<std::size_t>(left - open_.data()));
    test.follow(wanted_);
}

void NearSet::restart_tests()
{
    looks_.clear();
    disturbed_ |= resting_;
    is_disturbed_ = true;
}

// Drops stale pairs and visits the other active ones. The visitor is passed by value and returned: what it counts stays in
// registers.
template <typename Visit> Visit NearSet::visit_active(const MeasuredBox *boxes, Tick now, bool prefetches, Visit visit)
{
    if (!prefetches)
        return visit_active(
            now, [](const CandidatePair &) {}, visit);
    return visit_active(
        now,
        [boxes](const CandidatePair &pair) {
            prefetch(&boxes[pair.first]);
            prefetch(&boxes[pair.second]);
        },
        visit);
}

// Not inlined: within a larger function there would not be enough registers for the loop.
template <typename Fetch, typename Visit>
[[gnu::noinline]] Visit NearSet::visit_active(Tick now, Fetch fetch, Visit visit)
{
    if (may_have_stale(now))
        return drop_stale(now, fetch, visit, keep_nothing);
    const NearPair *const pairs = pairs_.data();
    for (std::size_t i = 0, count = pairs_.size(); i < count; ++i)
    {
        fetch(pairs[std::min(i + tuning::pairs_ahead, count - 1)]);
        visit(pairs[i]);
    }
    return visit;
}

void NearSet::drop_stale(Tick now)
{
    activate_disturbed();
    const auto ignore = [](const NearPair &) {};
    if (looks_.empty())
    {
        drop_stale(now, ignore, ignore, keep_nothing);
        return;
    }
    looks_.resize(pairs_.size());
    drop_stale(now, ignore, ignore, keep_beside(looks_));
}

// @param keep called with the old and the new place of each pair that is moved.
template <typename Fetch, typename Visit, typename Keep>
[[gnu::noinline]] Visit NearSet::drop_stale(Tick now, Fetch fetch, Visit visit, Keep keep)
{
    NearPair *const pairs = pairs_.data(), *left = pairs;
    const std::size_t count = pairs_.size(), settled = settled_;
    std::int32_t next_leave = NearPair::for_long;
    for (std::size_t i = 0; i < count; ++i)
    {
        fetch(pairs[std::min(i + tuning::pairs_ahead, count - 1)]);
        const NearPair pair = pairs[i];
        const std::int32_t ticks_left = pair.ticks_left(now);
        if (ticks_left < 0 || ((i < settled) & is_retired(pair)))
        {
            count_out(pair);
            continue;
        }
        next_leave = std::min(next_leave, ticks_left);
        visit(pair);
        if (left != &pairs[i]) // memory that is not written stays clean
        {
            *left = pair;
            keep(i, static_cast<std::size_t>(left - pairs));
        }
        ++left;
    }
    settle(left);
    forget_retired();
    next_leave_ = now + static_cast<Tick>(next_leave);
    return visit;
}

// Makes the pairs of all disturbed objects active.
void NearSet::activate_disturbed()
{
    if (!is_disturbed_)
        return;
    activate_disturbed(overlapping_);
    activate_disturbed(separated_);
    resting_ -= disturbed_;
    disturbed_.clear();
    is_disturbed_ = false;
}

void NearSet::activate_disturbed(std::vector<NearPair> &pairs)
{
    NearPair *left = pairs.data();
    for (const NearPair &pair : pairs)
        if (!is_disturbed(pair))
            *left++ = pair;
        else if (is_retired(pair))
            count_out(pair);
        else
            pairs_.push_back(pair);
    pairs.resize(static_cast<std::size_t>(left - pairs.data()));
}

// Lets those pairs rest whose objects have not moved since the last call; their states are known from now on.
//
// @param overlap says of the pair in a place whether its objects overlap.
template <typename Overlap, typename Keep> void NearSet::let_rest(Overlap overlap, Keep keep)
{
    NearPair *left = pairs_.data();
    for (std::size_t i = 0; i < pairs_.size(); ++i)
    {
        const NearPair pair = pairs_[i];
        if (moved_.contains(pair.first) || moved_.contains(pair.second))
        {
            keep(i, static_cast<std::size_t>(left - pairs_.data()));
            *left++ = pair;
        }
        else
            rest(overlap(i) ? overlapping_ : separated_, pair);
    }
    settle(left);
    moved_.clear();
}

void NearSet::clear()
{
    for (std::vector<NearPair> *pairs : {&pairs_, &overlapping_, &separated_})
        pairs->clear();
    looks_.clear();
    for (IdSet *set : {&members_, &resting_, &disturbed_, &moved_})
        set->clear();
    retired_.clear();
    std::fill(is_retired_.begin(), is_retired_.end(), std::uint8_t{0});
    std::fill(counts_.begin(), counts_.end(), 0u);
    settled_ = 0;
    is_disturbed_ = false;
}

void NearSet::release()
{
    clear();
    for (std::vector<NearPair> *pairs : {&pairs_, &overlapping_, &separated_})
        free_memory(*pairs);
    free_memory(looks_);
    free_memory(open_);
    free_memory(retired_);
}
} // namespace ode_predictive_space
