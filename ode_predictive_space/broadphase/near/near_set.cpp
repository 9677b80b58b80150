#include "ode_predictive_space/broadphase/near/near_set.h"

#include <algorithm>

#include "ode_predictive_space/broadphase/base/prefetch.h"

namespace ode_predictive_space
{
CandidatePair *NearSet::report(const OverlapTest &test, Place *places, UpdateNumber update, CandidatePair *room)
{
    activate_disturbed();
    CandidatePair *end = room;
    for (const CandidatePair &pair : pairs_)
        if (test(pair))
            *end++ = pair;
    end = std::copy(overlapping_.begin(), overlapping_.end(), end);
    if (is_time_to_rest())
        let_rest(places, update, [&](std::size_t i) { return test(pairs_[i]); });
    return end;
}

CandidatePair *NearSet::report_by_shape(ShapeTest &test, Place *places, UpdateNumber update, CandidatePair *room)
{
    activate_disturbed();
    looks_.resize(pairs_.size());
    follow_postponed(test);
    find_open(test);
    CandidatePair *end = room;
    for (std::uint32_t i : open_)
    {
        *end = pairs_[i];
        end += looks_[i].pause > 0 ? looks_[i].pause-- > 0 : test.may_touch(pairs_[i], looks_[i]);
    }
    end = std::copy(overlapping_.begin(), overlapping_.end(), end);
    if (is_time_to_rest())
    {
        let_rest(places, update, [&](std::size_t i) {
            return looks_[i].due == 0 && test.boxes_overlap(pairs_[i]) && test.may_touch(pairs_[i], looks_[i]);
        });
        wanted_.clear();
        for_each([this](const CandidatePair &pair, PairState) { want(pair); });
        test.keep_only(wanted_);
    }
    return end;
}

// Brings the travels of postponed pairs up to date. A pair of an object whose shape is another one now is as good as new, also one
// at rest: a hull may change without a move.
void NearSet::follow_postponed(ShapeTest &test)
{
    wanted_.clear();
    for_each([this](const CandidatePair &pair, PairState) { want(pair); });
    test.renew_outdated(wanted_);
    wanted_.clear();
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        if (looks_[i].due > 0)
            want(pairs_[i]);
    test.follow(wanted_);
    if (!test.shapes().any_renewed())
        return;
    test.shapes().renewed().for_each([this](ProxyId id) { disturb(id); });
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
            if (!test.boxes_overlap(pairs_[i]))
                continue;
            open_.push_back(static_cast<std::uint32_t>(i));
            if (looks_[i].pause == 0)
                want(pairs_[i]);
        }
    test.follow(wanted_);
}

// Makes the pairs of all disturbed objects active.
void NearSet::activate_disturbed()
{
    if (disturbed_.empty())
        return;
    wanted_.clear();
    for (ProxyId id : disturbed_)
        wanted_.insert(id);
    disturbed_.clear();
    activate_disturbed(overlapping_);
    activate_disturbed(separated_);
}

void NearSet::activate_disturbed(std::vector<CandidatePair> &pairs)
{
    CandidatePair *left = pairs.data();
    for (const CandidatePair &pair : pairs)
        if (wanted_.contains(pair.first) || wanted_.contains(pair.second))
            pairs_.push_back(pair);
        else
            *left++ = pair;
    const auto kept = static_cast<std::size_t>(left - pairs.data());
    woken_ += pairs.size() - kept;
    pairs.resize(kept);
}

// Lets those pairs rest whose objects have not moved since the last call; their states are known from now on.
//
// @param overlap says of the i-th pair whether its objects overlap.
template <typename Overlap> void NearSet::let_rest(Place *places, UpdateNumber update, Overlap overlap)
{
    const auto moved = [&](ProxyId id) { return updates_between(rested_, places[id].moved()) > 0; };
    keep_pairs([&](const CandidatePair &pair, std::size_t i) {
        const bool stays = moved(pair.first) || moved(pair.second);
        if (!stays)
            rest(overlap(i) ? overlapping_ : separated_, pair, places);
        return stays;
    });
    rested_ = update;
}

void NearSet::rest(std::vector<CandidatePair> &pairs, const CandidatePair &pair, Place *places)
{
    pairs.push_back(pair);
    for (ProxyId id : {pair.first, pair.second})
    {
        resting_.insert(id);
        places[id].set_watch(Watch::look);
    }
}

void NearSet::clear()
{
    for (std::vector<CandidatePair> *pairs : {&pairs_, &overlapping_, &separated_})
        pairs->clear();
    looks_.clear();
    resting_.clear();
    disturbed_.clear();
    std::fill(is_retired_.begin(), is_retired_.end(), std::uint8_t{0});
    has_retired_ = false;
}

void NearSet::release()
{
    clear();
    for (std::vector<CandidatePair> *pairs : {&pairs_, &overlapping_, &separated_})
        free_memory(*pairs);
    free_memory(looks_);
    free_memory(open_);
    free_memory(disturbed_);
}
} // namespace ode_predictive_space
