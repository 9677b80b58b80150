#include "ode_predictive_space/broadphase/near/near_set.h"

#include <algorithm>

#include "ode_predictive_space/broadphase/base/prefetch.h"

namespace ode_predictive_space
{
CandidatePair *NearSet::report(const OverlapTest &test, Place *places, UpdateNumber update, CandidatePair *room)
{
    activate_disturbed();
    CandidatePair *end = test.copy_overlapping(pairs_, room);
    end = std::copy(overlapping_.begin(), overlapping_.end(), end);
    if (is_time_to_rest() || rests_early())
        let_rest(places, update, [&](std::size_t i) { return test(pairs_[i]); });
    return end;
}

CandidatePair *NearSet::report_by_shape(ShapeTest &test, Place *places, UpdateNumber update, CandidatePair *room)
{
    activate_disturbed();
    make_looks(test);
    test.build();
    renew_outdated(test);
    follow_postponed(test);
    CandidatePair *end = find_open(test, room);
    end = look_at_open(test, room, end);
    end = std::copy(overlapping_.begin(), overlapping_.end(), end);
    if (payoff_.end_report())
        reset_cheap_looks();
    if (is_time_to_rest())
    {
        // As they were reported. (The shapes of those that were not looked at are out of date.)
        let_rest(places, update, [&](std::size_t i) { return looks_[i].due == 0 && test.boxes_overlap(pairs_[i]); });
        wanted_.clear();
        has_dear_ = false;
        for_each([&](const CandidatePair &pair, PairState) {
            want(pair);
            has_dear_ |= !test.is_cheap(pair);
        });
        test.keep_only(wanted_);
    }
    return end;
}

// While only cheap pairs are near, and looks at these do not pay, nothing of shapes is needed.
CandidatePair *NearSet::report_cheap(const OverlapTest &boxes, Place *places, UpdateNumber update, CandidatePair *room)
{
    looks_.clear();
    CandidatePair *end = report(boxes, places, update, room);
    if (!payoff_.end_report())
        return end;
    Look cheap;
    cheap.is_cheap = true;
    looks_.assign(pairs_.size(), cheap);
    reset_cheap_looks();
    return end;
}

void NearSet::make_looks(const ShapeTest &test)
{
    const std::size_t known = looks_.size();
    looks_.resize(pairs_.size());
    for (std::size_t i = known; i < pairs_.size(); ++i)
        looks_[i].is_cheap = test.is_cheap(pairs_[i]);
}

// A hull may change without a move.
void NearSet::renew_outdated(ShapeTest &test)
{
    if (!test.shapes().any_hulls())
        return;
    wanted_.clear();
    for_each([this](const CandidatePair &pair, PairState) { want(pair); });
    test.renew_outdated(wanted_);
}

// Brings the travels of postponed pairs up to date. A pair of an object whose shape is another one now is as good as new, also one
// at rest.
void NearSet::follow_postponed(ShapeTest &test)
{
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
        {
            looks_[i] = {};
            looks_[i].is_cheap = test.is_cheap(pairs_[i]);
        }
}

// Writes the pairs that are not postponed and whose boxes overlap. Those that are to be looked at are in open_, too; their shapes are
// up to date.
CandidatePair *NearSet::find_open(ShapeTest &test, CandidatePair *room)
{
    wanted_.clear();
    open_.clear();
    CandidatePair *end = room;
    for (std::size_t i = 0; i < pairs_.size(); ++i)
    {
        Look &look = looks_[i];
        if (look.due > 0 && test.postpones(pairs_[i], look))
        {
            if (look.is_cheap)
                payoff_.note_postponed();
            continue;
        }
        if (!test.boxes_overlap(pairs_[i]))
        {
            look.due = 0;
            continue;
        }
        if (look.pause > 0)
            --look.pause;
        else if (!look.is_cheap || payoff_.pays())
        {
            open_.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(end - room)});
            want(pairs_[i]);
        }
        *end++ = pairs_[i];
    }
    test.follow(wanted_);
    return end;
}

// Takes those back whose shapes cannot touch.
CandidatePair *NearSet::look_at_open(ShapeTest &test, CandidatePair *room, CandidatePair *end)
{
    constexpr CandidatePair none{0, 0};
    CandidatePair *first_taken_back = end;
    for (const auto &[i, place] : open_)
        if (!test.looks_near(pairs_[i], looks_[i], payoff_))
        {
            room[place] = none;
            first_taken_back = std::min(first_taken_back, room + place);
        }
    return std::remove_if(first_taken_back, end, [](const CandidatePair &pair) { return pair.first == pair.second; });
}

// The cheap pairs, when it has changed whether looks at these pay: their next looks are spread.
void NearSet::reset_cheap_looks()
{
    for (std::size_t i = 0; i < looks_.size(); ++i)
        if (looks_[i].is_cheap)
        {
            looks_[i].due = 0;
            looks_[i].pause = static_cast<std::uint8_t>(i % tuning::longest_pause);
        }
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
    give_back_spare(pairs_);
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
