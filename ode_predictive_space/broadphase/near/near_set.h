// Last stage of the tick: the near set, the pairs that may overlap now.
//
// In: near pairs, when their time has come. Out: at each tick those of them that do overlap.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_NEAR_SET_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_NEAR_SET_H

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/near/overlap_test.h"
#include "ode_predictive_space/broadphase/near/shape_test.h"
#include "ode_predictive_space/broadphase/schedule/pairs.h"

namespace ode_predictive_space
{
/// What is known of a near pair.
enum class PairState
{
    active,     ///< nothing that lasts: the pair is tested at each tick
    separated,  ///< the pair rests, and its objects do not overlap; or their shapes do not touch
    overlapping ///< the pair rests, and its objects overlap; or their shapes may touch
};

/// Pairs in the order in which they were added, and the set of objects that are in them. The pairs of each object are counted,
/// so that this set need not be made anew whenever a pair is dropped.
///
/// A pair is active, or it rests until one of its objects moves. When an object is retired, all its pairs become stale; they are
/// dropped later, all at once.
class NearSet
{
public:
    /// Makes room for objects 0 to count - 1.
    void resize(std::size_t count)
    {
        for (IdSet *set : {&members_, &resting_, &disturbed_, &moved_, &wanted_})
            set->resize(count);
        resize_array(counts_, count);
        resize_array(is_retired_, count);
    }

    void add(const NearPair &pair)
    {
        pairs_.push_back(pair);
        count_in(pair.first);
        count_in(pair.second);
    }

    /// The object has got another prediction or is gone: only its pairs that are added from now on count.
    void retire(ProxyId id, Tick now)
    {
        if (!members_.contains(id))
            return;
        // Pairs that were added since the last drop must not be taken for pairs added after this one.
        if (settled_ != pairs_.size())
            drop_stale(now);
        disturb(id);
        if (!is_retired_[id])
            retired_.push_back(id);
        is_retired_[id] = true;
    }

    /// These objects have moved: their pairs must not rest.
    void note_moves(const IdSet &moved)
    {
        moved_ |= moved;
        if (overlapping_.empty() && separated_.empty())
            return;
        for (std::size_t i = 0; i < moved.words(); ++i)
            IdSet::visit_word(i, moved.word(i) & resting_.word(i), [this](ProxyId id) { disturb(id); });
    }

    /// Room that report() needs for its pairs.
    std::size_t most_pairs() const { return pairs_.size() + overlapping_.size() + separated_.size(); }

    /// Writes the pairs that overlap to `room`, which has room for most_pairs(). The boxes of all members() are up to date.
    ///
    /// @return the end of what was written.
    CandidatePair *report(const OverlapTest &test, Tick now, bool prefetches, CandidatePair *room);

    /// The same for pairs that overlap and whose shapes may touch. Boxes and shapes are brought up to date where they are needed.
    CandidatePair *report_by_shape(ShapeTest &test, Tick now, CandidatePair *room);

    /// Forgets all that is known of pairs, because they are tested in another way from now on.
    void restart_tests();

    /// Drops all pairs.
    void clear();
    /// The same, and gives their memory back.
    void release();

    /// Calls visit(pair, state) for all pairs that are not stale.
    template <typename Visit> void for_each(Visit visit) const
    {
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            if (i >= settled_ || !is_retired(pairs_[i]))
                visit(pairs_[i], PairState::active);
        for_resting(overlapping_, PairState::overlapping, visit);
        for_resting(separated_, PairState::separated, visit);
    }

    /// Calls visit(pair) for the active pairs that were postponed at the last report.
    template <typename Visit> void for_each_postponed(const MeasuredShapes &shapes, Visit visit) const
    {
        for (std::size_t i = 0; i < looks_.size(); ++i)
            if (!is_retired(pairs_[i]) && shapes.travel(pairs_[i]) < looks_[i].due)
                visit(pairs_[i]);
    }

    /// Active pairs; stale ones among them.
    const std::vector<NearPair> &active() const { return pairs_; }
    /// Pairs that rest and overlap; until the next report, some that were disturbed among them.
    const std::vector<NearPair> &overlapping() const { return overlapping_; }
    /// Objects in any pair.
    const IdSet &members() const { return members_; }

    std::size_t bytes() const
    {
        return bytes_of(pairs_) + bytes_of(looks_) + bytes_of(overlapping_) + bytes_of(separated_) + bytes_of(counts_) +
               bytes_of(retired_) + bytes_of(is_retired_) + members_.bytes() + resting_.bytes() + disturbed_.bytes() +
               moved_.bytes() + wanted_.bytes() + bytes_of(open_);
    }

private:
    void disturb(ProxyId id)
    {
        if (!resting_.contains(id))
            return;
        disturbed_.insert(id);
        is_disturbed_ = true;
    }

    void follow_postponed(ShapeTest &test);
    void find_open(ShapeTest &test);
    void want(const CandidatePair &pair)
    {
        wanted_.insert(pair.first);
        wanted_.insert(pair.second);
    }

    void activate_disturbed();
    template <typename Visit> Visit visit_active(const MeasuredBox *boxes, Tick now, bool prefetches, Visit visit);
    template <typename Fetch, typename Visit> Visit visit_active(Tick now, Fetch fetch, Visit visit);
    template <typename Overlap, typename Keep> void let_rest(Overlap overlap, Keep keep);

    // Pairs have been added or become stale since the last time, or have left each other.
    bool may_have_stale(Tick now) const
    {
        return !retired_.empty() || settled_ != pairs_.size() || ticks_between(now, next_leave_) < 0;
    }

    void drop_stale(Tick now);
    template <typename Fetch, typename Visit, typename Keep>
    Visit drop_stale(Tick now, Fetch fetch, Visit visit, Keep keep);

    void settle(const NearPair *end)
    {
        pairs_.resize(static_cast<std::size_t>(end - pairs_.data()));
        settled_ = pairs_.size();
        looks_.resize(std::min(looks_.size(), settled_));
    }

    void rest(std::vector<NearPair> &pairs, const NearPair &pair)
    {
        pairs.push_back(pair);
        resting_.insert(pair.first);
        resting_.insert(pair.second);
    }

    bool is_disturbed(const NearPair &pair) const
    {
        return disturbed_.contains(pair.first) || disturbed_.contains(pair.second);
    }

    bool is_retired(const NearPair &pair) const { return (is_retired_[pair.first] | is_retired_[pair.second]) != 0; }

    void forget_retired()
    {
        for (ProxyId id : retired_)
            is_retired_[id] = false;
        retired_.clear();
    }

    void activate_disturbed(std::vector<NearPair> &pairs);

    template <typename Visit> void for_resting(const std::vector<NearPair> &pairs, PairState state, Visit &visit) const
    {
        for (const NearPair &pair : pairs)
            if (!is_retired(pair))
                visit(pair, is_disturbed(pair) ? PairState::active : state);
    }

    void count_in(ProxyId id)
    {
        if (counts_[id]++ == 0)
            members_.insert(id);
    }

    void count_out(const NearPair &pair)
    {
        for (ProxyId id : {pair.first, pair.second})
            if (--counts_[id] == 0)
                members_.erase(id);
    }

    std::vector<NearPair> pairs_; // active
    std::vector<Look> looks_;     // of the first so many of these; none unless pairs are tested by shape
    std::size_t settled_ = 0;     // the first so many were there when stale ones were last dropped
    Tick next_leave_ = 0;         // the last tick at which none of these has left
    std::vector<NearPair> overlapping_, separated_; // at rest
    IdSet members_;
    IdSet resting_;   // all objects of pairs at rest, and maybe some whose partners have been disturbed
    IdSet disturbed_; // of these
    bool is_disturbed_ = false;
    IdSet moved_;                          // since pairs were last let rest
    unsigned reports_ = 0;                 // so far; decides when pairs are let rest
    std::vector<ProxyId> retired_;         // since stale pairs were last dropped
    std::vector<std::uint8_t> is_retired_; // bytes, not bits: two are looked up for each pair
    std::vector<std::uint32_t> counts_;    // pairs of each object
    IdSet wanted_;                         // scratch
    std::vector<std::uint32_t> open_;      // scratch
};
} // namespace ode_predictive_space

#endif
