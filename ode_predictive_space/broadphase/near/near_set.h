// The near set: the pairs whose envelopes overlap. In: such pairs, when one of their objects has got another envelope. Out: at each
// tick those of them that do overlap.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_NEAR_SET_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_NEAR_SET_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/near/overlap_test.h"
#include "ode_predictive_space/broadphase/near/shape_test.h"

namespace ode_predictive_space
{
/// What is known of a near pair.
enum class PairState
{
    active,     ///< nothing that lasts: the pair is tested at each tick
    separated,  ///< the pair rests, and its objects do not overlap; or their shapes do not touch
    overlapping ///< the pair rests, and its objects overlap; or their shapes may touch
};

/// Pairs that are all tested in the same way, in the order in which they became active.
struct NearPairs
{
    std::vector<CandidatePair> active;
    std::vector<CandidatePair> overlapping, separated; ///< at rest

    std::size_t resting() const { return overlapping.size() + separated.size(); }
    std::size_t size() const { return active.size() + resting(); }
    std::size_t bytes() const { return bytes_of(active) + bytes_of(overlapping) + bytes_of(separated); }
};

/// A pair is active, or it rests until one of its objects moves. When an object is retired, all its pairs are stale, and are dropped
/// together with those of others.
class NearSet
{
public:
    /// Makes room for objects 0 to count - 1.
    void resize(std::size_t count)
    {
        for (IdSet *set : {&resting_, &apart_, &wanted_})
            set->resize(count);
        resize_array(is_retired_, count);
    }

    /// @param by_shape the contacts of the pair are costly to find: it is reported when its shapes may touch.
    void add(const CandidatePair &pair, bool by_shape) { (by_shape ? by_shape_ : by_box_).active.push_back(pair); }

    /// The object is getting another envelope, or is gone.
    void retire(ProxyId id)
    {
        disturb(id);
        is_retired_[id] = true;
        has_retired_ = true;
    }

    /// The object is gone. Throws nothing.
    void close_account(ProxyId id) { budget_.close(id); }

    bool has_retired() const { return has_retired_; }

    /// The object has moved: its pairs must not rest.
    void disturb(ProxyId id)
    {
        if (!resting_.contains(id))
            return;
        disturbed_.push_back(id);
        resting_.erase(id);
    }
    bool rests(ProxyId id) const { return resting_.contains(id); }

    /// Drops the pairs of all retired objects, and calls visit(pair) for each before.
    template <typename Visit> void drop_retired(Visit visit);

    /// Room that report() needs for its pairs.
    std::size_t most_pairs() const { return by_box_.size() + by_shape_.size(); }

    /// Writes the pairs that overlap to `room`, which has room for most_pairs(). Now and then, pairs whose objects have not moved
    /// come to rest.
    ///
    /// @param update the present one.
    /// @return the end of what was written.
    CandidatePair *report(const OverlapTest &test, UpdateNumber update, CandidatePair *room);

    /// Does the same, but writes pairs that were added by shape only when they overlap and their shapes may touch. Shapes are brought up
    /// to date where they are needed.
    CandidatePair *report(ShapeTest &test, UpdateNumber update, CandidatePair *room);

    /// The objects of the pairs that the last report let rest, some of them several times. Their next moves must be seen.
    const std::vector<ProxyId> &newly_resting() const { return newly_resting_; }

    /// Drops all pairs.
    void clear();
    /// The same, and gives their memory back.
    void release();

    /// Calls visit(pair, state) for all pairs that are not stale.
    template <typename Visit> void for_each(Visit visit) const
    {
        for (const NearPairs *pairs : {&by_box_, &by_shape_})
        {
            for_current(pairs->active, PairState::active, visit);
            for_current(pairs->overlapping, PairState::overlapping, visit);
            for_current(pairs->separated, PairState::separated, visit);
        }
    }

    /// Calls visit(pair) for the active pairs that were postponed at the last report, and whose shapes are the ones of that report.
    template <typename Visit> void for_each_postponed(const MeasuredShapes &shapes, Visit visit) const
    {
        for (std::size_t i = 0; i < gaps_.size(); ++i)
        {
            const CandidatePair &pair = by_shape_.active[i];
            if (!is_retired(pair) && !shapes.renewed(pair) && shapes.travel(pair) < gaps_[i].due)
                visit(pair);
        }
    }

    /// Active pairs that are tested by box; stale ones among them.
    const std::vector<CandidatePair> &active() const { return by_box_.active; }
    /// Pairs at rest.
    std::size_t resting() const { return by_box_.resting() + by_shape_.resting(); }
    /// Pairs that have rested and do not any more, since the set was made.
    std::uint64_t woken() const { return woken_; }

    std::size_t bytes() const
    {
        return by_box_.bytes() + by_shape_.bytes() + bytes_of(gaps_) + bytes_of(is_retired_) + bytes_of(disturbed_) +
               bytes_of(newly_resting_) + resting_.bytes() + apart_.bytes() + wanted_.bytes() + bytes_of(open_) +
               budget_.bytes();
    }

private:
    /// A pair to look at.
    struct Open
    {
        std::uint32_t number; ///< among by_shape_.active
        std::uint32_t place;  ///< among those that are written
    };

    void begin_report();
    CandidatePair *report_by_box(const OverlapTest &test, CandidatePair *room);
    CandidatePair *report_by_shape(ShapeTest &test, bool all_shapes, CandidatePair *room);
    void make_gap_caches(const ShapeTest &test);
    void follow(ShapeTest &test, bool all_shapes);
    CandidatePair *find_open(ShapeTest &test, CandidatePair *room);
    void charge_for_shapes(const MeasuredShapes &shapes);
    bool is_due(const ShapeTest &test, const CandidatePair &pair, GapCache &cache);
    CandidatePair *check_open(ShapeTest &test, CandidatePair *room, CandidatePair *end);
    void want(const CandidatePair &pair)
    {
        wanted_.insert(pair.first);
        wanted_.insert(pair.second);
    }

    void want_all_by_shape();

    /// Keeps those active pairs by shape for which stays(pair, its number) is true, with their looks.
    template <typename Stays> void keep_by_shape(Stays stays);

    void activate_disturbed();
    std::size_t activate_disturbed(std::vector<CandidatePair> &resting, std::vector<CandidatePair> &active);
    bool is_time_to_rest()
    {
        // Most of what never moves is there from the beginning.
        ++reports_;
        return reports_ == 2 || reports_ == 8 || reports_ % tuning::reports_per_rest == 0;
    }
    void let_rest(const OverlapTest &test);
    void let_rest_by_shape(const OverlapTest &test);
    bool may_rest(const CandidatePair &pair, const Place *places) const
    {
        const auto rests = [&](ProxyId id) { return updates_between(rested_, places[id].moved()) <= 0; };
        return rests(pair.first) && rests(pair.second);
    }
    void rest(std::vector<CandidatePair> &pairs, const CandidatePair &pair);

    bool is_retired(const CandidatePair &pair) const
    {
        return (is_retired_[pair.first] | is_retired_[pair.second]) != 0;
    }

    template <typename Visit>
    void for_current(const std::vector<CandidatePair> &pairs, PairState state, Visit &visit) const
    {
        for (const CandidatePair &pair : pairs)
            if (!is_retired(pair))
                visit(pair, state);
    }

    NearPairs by_box_, by_shape_;
    std::vector<GapCache> gaps_;     // of the first so many of by_shape_.active; the others are new
    IdSet resting_;                  // objects with a pair at rest
    std::vector<ProxyId> disturbed_; // were among them
    std::vector<ProxyId> newly_resting_;
    IdSet apart_; // objects with a pair by shape that rested apart when pairs were last let rest
    std::uint64_t woken_ = 0;
    unsigned reports_ = 0;                 // so far; decides when pairs are let rest
    UpdateNumber rested_ = 0;              // when that was last
    std::vector<std::uint8_t> is_retired_; // bytes, not bits: two are looked up for each pair
    bool has_retired_ = false;
    GapBudget budget_;
    IdSet wanted_;           // scratch
    std::vector<Open> open_; // scratch
};

template <typename Stays> void NearSet::keep_by_shape(Stays stays)
{
    std::vector<CandidatePair> &pairs = by_shape_.active;
    const std::size_t tested = gaps_.size();
    std::size_t left = 0, kept = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
        if (!stays(pairs[i], i))
            continue;
        if (i < tested)
            gaps_[kept++] = gaps_[i];
        pairs[left++] = pairs[i];
    }
    pairs.resize(left);
    gaps_.erase(gaps_.begin() + static_cast<std::ptrdiff_t>(kept), gaps_.end());
}

template <typename Visit> void NearSet::drop_retired(Visit visit)
{
    activate_disturbed();
    if (!has_retired_)
        return;
    const auto goes = [&](const CandidatePair &pair) {
        const bool goes = is_retired(pair);
        if (goes)
            visit(pair);
        return goes;
    };
    by_box_.active.erase(std::remove_if(by_box_.active.begin(), by_box_.active.end(), goes), by_box_.active.end());
    keep_by_shape([&](const CandidatePair &pair, std::size_t) { return !goes(pair); });
    std::fill(is_retired_.begin(), is_retired_.end(), std::uint8_t{0});
    has_retired_ = false;
}
} // namespace ode_predictive_space

#endif
