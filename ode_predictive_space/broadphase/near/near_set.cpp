#include "ode_predictive_space/broadphase/near/near_set.h"

#include <algorithm>

namespace ode_predictive_space
{
CandidatePair *NearSet::report(const OverlapTest &test, std::optional<ShapeTest> &by_shape, UpdateNumber update,
                               CandidatePair *room)
{
    activate_disturbed();
    const bool some_may_rest = is_time_to_rest();
    CandidatePair *end = test.copy_overlapping(by_box_.active, room);
    end = std::copy(by_box_.overlapping.begin(), by_box_.overlapping.end(), end);
    if (by_shape_.size() > 0)
        end = report_by_shape(*by_shape, some_may_rest, end);
    if (!some_may_rest)
        return end;
    let_rest(test);
    if (by_shape)
    {
        let_rest_by_shape(test);
        wanted_.clear();
        want_all_by_shape();
        by_shape->shapes.keep_only(wanted_);
    }
    rested_ = update;
    return end;
}

CandidatePair *NearSet::report_by_shape(ShapeTest &test, bool all_shapes, CandidatePair *room)
{
    budget_.begin_report();
    make_gap_caches(test);
    follow(test, all_shapes);
    CandidatePair *end = find_open(test, room);
    end = check_open(test, room, end);
    return std::copy(by_shape_.overlapping.begin(), by_shape_.overlapping.end(), end);
}

void NearSet::make_gap_caches(const ShapeTest &test)
{
    for (std::size_t i = gaps_.size(); i < by_shape_.active.size(); ++i)
    {
        gaps_.push_back(test.new_gap_cache(by_shape_.active[i]));
        if (const ProxyId *payer = gaps_[i].payer_of(by_shape_.active[i]))
            budget_.note_new_pair(*payer);
    }
}

void NearSet::want_all_by_shape()
{
    for (const std::vector<CandidatePair> *pairs : {&by_shape_.active, &by_shape_.overlapping, &by_shape_.separated})
        for (const CandidatePair &pair : *pairs)
            want(pair);
}

// Updates the shapes of postponed and separated pairs. When pairs may rest, it updates all measured shapes, because changed
// data may have separated a reported pair. If a shape was replaced, the pairs of its object count as new ones.
void NearSet::follow(ShapeTest &test, bool all_shapes)
{
    wanted_ = apart_;
    if (all_shapes)
        test.shapes.add_owners_to(wanted_);
    for (std::size_t i = 0; i < gaps_.size(); ++i)
        if (gaps_[i].due > 0)
            want(by_shape_.active[i]);
    test.follow(wanted_);
    if (test.shapes.renewed().empty())
        return;
    test.shapes.renewed().for_each([this](ProxyId id) { disturb(id); });
    activate_disturbed();
    make_gap_caches(test);
    for (std::size_t i = 0; i < gaps_.size(); ++i)
        if (test.shapes.renewed(by_shape_.active[i]))
            gaps_[i] = test.new_gap_cache(by_shape_.active[i]);
}

// Writes the pairs that are not postponed and whose boxes overlap. Pairs that are due for a gap check also go to open_.
CandidatePair *NearSet::find_open(ShapeTest &test, CandidatePair *room)
{
    wanted_.clear();
    open_.clear();
    CandidatePair *end = room;
    for (std::size_t i = 0; i < gaps_.size(); ++i)
    {
        GapCache &cache = gaps_[i];
        const CandidatePair &pair = by_shape_.active[i];
        if (cache.due > 0 && test.postpones(pair, cache))
        {
            if (const ProxyId *payer = cache.payer_of(pair))
                budget_.note_spared(*payer);
            continue;
        }
        if (!test.boxes(pair))
        {
            cache.due = 0;
            continue;
        }
        if (is_due(test, pair, cache))
        {
            open_.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(end - room)});
            want(pair);
        }
        *end++ = pair;
    }
    test.follow(wanted_);
    return end;
}

// Hulls of data that change at each tick would cost more than their checks save.
void NearSet::charge_for_shapes(const MeasuredShapes &shapes)
{
    shapes.renewed().for_each([&](ProxyId id) {
        if (!shapes.has_shape(id) || !shapes[id].hull)
            return;
        const VertexHull &hull = *shapes[id].hull;
        budget_.note_hull(id, hull.number, hull.elements());
    });
}

// Whether to check the gap of an overlapping pair now: its pause is over, its account allows it, and no filter excludes it.
bool NearSet::is_due(const ShapeTest &test, const CandidatePair &pair, GapCache &cache)
{
    const ProxyId *payer = cache.payer_of(pair);
    if (cache.pause == 0 && (!payer || budget_.allows_check(*payer)))
    {
        cache.is_excluded = test.boxes.scene.is_excluded(pair.first, pair.second);
        if (!cache.is_excluded)
            return true;
        wait_longer(cache);
    }
    cache.due = 0;
    cache.pause -= cache.pause > 0;
    if (payer && !cache.is_excluded)
        budget_.note_reported(*payer);
    return false;
}

// Removes the written pairs whose shapes cannot touch.
CandidatePair *NearSet::check_open(ShapeTest &test, CandidatePair *room, CandidatePair *end)
{
    charge_for_shapes(test.shapes);
    constexpr CandidatePair none{0, 0};
    CandidatePair *first_taken_back = end;
    for (const auto &[i, place] : open_)
        if (!test.check_gap(by_shape_.active[i], gaps_[i], budget_))
        {
            room[place] = none;
            first_taken_back = std::min(first_taken_back, room + place);
        }
    return std::remove_if(first_taken_back, end, [](const CandidatePair &pair) { return pair.first == pair.second; });
}

void NearSet::activate_disturbed()
{
    if (!has_disturbed_)
        return;
    has_disturbed_ = false;
    for (NearPairs *pairs : {&by_box_, &by_shape_})
    {
        woken_ += activate_disturbed(pairs->overlapping, pairs->active);
        woken_ += activate_disturbed(pairs->separated, pairs->active);
    }
}

std::size_t NearSet::activate_disturbed(std::vector<CandidatePair> &resting, std::vector<CandidatePair> &active)
{
    CandidatePair *left = resting.data();
    for (const CandidatePair &pair : resting)
        if (resting_.contains(pair.first) && resting_.contains(pair.second))
            *left++ = pair;
        else
            active.push_back(pair);
    const auto kept = static_cast<std::size_t>(left - resting.data());
    const std::size_t activated = resting.size() - kept;
    resting.resize(kept);
    return activated;
}

void NearSet::let_rest(const OverlapTest &test)
{
    std::vector<CandidatePair> &active = by_box_.active;
    CandidatePair *left = active.data();
    for (const CandidatePair &pair : active)
        if (may_rest(pair, test.places))
            rest(test(pair) ? by_box_.overlapping : by_box_.separated, pair, test.places);
        else
            *left++ = pair;
    active.resize(static_cast<std::size_t>(left - active.data()));
    give_back_spare(active);
}

// The states are those of the last report, because shapes that needed no check are out of date.
void NearSet::let_rest_by_shape(const OverlapTest &test)
{
    keep_by_shape([&](const CandidatePair &pair, std::size_t i) {
        const bool rests = may_rest(pair, test.places);
        if (rests)
            rest(gaps_[i].due == 0 && test(pair) ? by_shape_.overlapping : by_shape_.separated, pair, test.places);
        return !rests;
    });
    give_back_spare(by_shape_.active);
    apart_.clear();
    for (const CandidatePair &pair : by_shape_.separated)
        for (ProxyId id : {pair.first, pair.second})
            apart_.insert(id);
}

// Each object is listed at its next notice.
void NearSet::rest(std::vector<CandidatePair> &pairs, const CandidatePair &pair, Place *places)
{
    pairs.push_back(pair);
    for (ProxyId id : {pair.first, pair.second})
    {
        resting_.insert(id);
        places[id].stop_watching();
    }
}

void NearSet::clear()
{
    for (NearPairs *pairs : {&by_box_, &by_shape_})
        *pairs = NearPairs();
    free_memory(gaps_);
    free_memory(open_);
    resting_.clear();
    apart_.clear();
    std::fill(is_retired_.begin(), is_retired_.end(), std::uint8_t{0});
    has_retired_ = has_disturbed_ = false;
}
} // namespace ode_predictive_space
