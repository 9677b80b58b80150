// The near set: the pairs whose envelopes overlap. In: pairs of new envelopes. Out: at each tick, the pairs to report.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_NEAR_SET_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_NEAR_SET_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/near/overlap_test.h"
#include "ode_predictive_space/broadphase/near/shape_test.h"

namespace ode_predictive_space
{
enum class PairState
{
    active,     ///< the pair is tested at each tick
    separated,  ///< the pair rests, and is not reported
    overlapping ///< the pair rests, and is reported without a test
};

struct NearPairs
{
    std::vector<CandidatePair> active;
    std::vector<CandidatePair> overlapping, separated; ///< resting pairs

    std::size_t resting() const { return overlapping.size() + separated.size(); }
    std::size_t size() const { return active.size() + resting(); }
    std::size_t bytes() const { return bytes_of(active) + bytes_of(overlapping) + bytes_of(separated); }
};

/// A pair is active, or it rests until one of its objects moves. Pairs of retired objects are stale until drop_retired().
class NearSet
{
public:
    void resize(std::size_t count)
    {
        for (IdSet *set : {&resting_, &apart_, &wanted_})
            set->resize(count);
        resize_array(is_retired_, count);
    }

    /// @param by_shape the pair is reported only if its shapes may touch.
    void add(const CandidatePair &pair, bool by_shape) { (by_shape ? by_shape_ : by_box_).active.push_back(pair); }

    /// The object gets a new envelope or is removed: its pairs are stale.
    void retire(ProxyId id)
    {
        disturb(id);
        is_retired_[id] = true;
        has_retired_ = true;
    }

    /// Closes the gap budget of a removed object. Throws nothing.
    void close_account(ProxyId id) { budget_.close(id); }

    bool has_retired() const { return has_retired_; }

    void disturb(ProxyId id)
    {
        if (!resting_.contains(id))
            return;
        resting_.erase(id);
        has_disturbed_ = true;
    }

    /// Drops the pairs of all retired objects, after visit(pair).
    template <typename Visit> void drop_retired(Visit visit);

    std::size_t most_pairs() const { return by_box_.size() + by_shape_.size(); }

    /// Writes the pairs that overlap; those that were added by shape, only if their shapes may touch, too. At some reports, pairs
    /// whose objects have not moved come to rest: the places of these are not watched any more.
    /// @param by_shape updates shapes as needed; none by box and by sphere.
    /// @param room for most_pairs(). @return the end of the written pairs.
    CandidatePair *report(const OverlapTest &test, std::optional<ShapeTest> &by_shape, UpdateNumber update,
                          CandidatePair *room);

    /// Gives the memory back, too.
    void clear();

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

    /// Calls visit(pair) for the active pairs that the last report postponed, unless their shapes have been replaced since.
    template <typename Visit> void for_each_postponed(const MeasuredShapes &shapes, Visit visit) const
    {
        for (std::size_t i = 0; i < gaps_.size(); ++i)
        {
            const CandidatePair &pair = by_shape_.active[i];
            if (!is_retired(pair) && !shapes.renewed(pair) && shapes.travel(pair) < gaps_[i].due)
                visit(pair);
        }
    }

    std::size_t resting() const { return by_box_.resting() + by_shape_.resting(); }
    std::uint64_t woken() const { return woken_; }

    std::size_t bytes() const
    {
        return by_box_.bytes() + by_shape_.bytes() + bytes_of(gaps_) + bytes_of(is_retired_) + resting_.bytes() +
               apart_.bytes() + wanted_.bytes() + bytes_of(open_) + budget_.bytes();
    }

private:
    /// A pair whose gap check is due.
    struct Open
    {
        std::uint32_t number; ///< index in by_shape_.active
        std::uint32_t place;  ///< index in the written pairs
    };

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

    /// Keeps the active pairs by shape, and their gap caches, for which stays(pair, index) is true.
    template <typename Stays> void keep_by_shape(Stays stays);

    void activate_disturbed();
    std::size_t activate_disturbed(std::vector<CandidatePair> &resting, std::vector<CandidatePair> &active);
    bool is_time_to_rest()
    {
        // The first two are early, because most objects that never move exist from the beginning.
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
    void rest(std::vector<CandidatePair> &pairs, const CandidatePair &pair, Place *places);

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
    std::vector<GapCache> gaps_; // by index of by_shape_.active; pairs without a test yet have none
    IdSet resting_;              // objects with resting pairs
    bool has_disturbed_ = false; // some resting pairs have an object that is not in resting_ any more
    IdSet apart_;                // objects with a separated pair by shape, as of the last let_rest_by_shape()
    std::uint64_t woken_ = 0;
    unsigned reports_ = 0;
    UpdateNumber rested_ = 0;              // the last update at which pairs could come to rest
    std::vector<std::uint8_t> is_retired_; // bytes, because two are read for each pair
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
