// The near set: the pairs that may overlap now.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SET_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SET_H

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ode_predictive_space/broadphase/assess.h"
#include "ode_predictive_space/broadphase/growth.h"
#include "ode_predictive_space/broadphase/id_set.h"
#include "ode_predictive_space/broadphase/prefetch.h"

namespace ode_predictive_space
{
/// Pairs in the order in which they came, and who is in them. How many pairs each is in is counted, so that the set of
/// members need not be made anew whenever a pair has gone.
///
/// A pair is tested at each tick, or it rests: then it is known whether its two objects overlap, until one of them is
/// disturbed. When an object is retired, all pairs that it is in become stale; they are dropped later, all at once.
class NearSet
{
public:
    /// What is known of a pair.
    enum class Verdict
    {
        open,    ///< nothing that lasts: it is tested at each tick
        apart,   ///< it rests, and its objects do not overlap
        together ///< it rests, and they do
    };

    /// Makes room for proxies 0 to count - 1.
    void resize(std::size_t count)
    {
        for (IdSet *set : {&members_, &resting_, &disturbed_})
            set->resize(count);
        grow(counts_, count);
        grow(is_retired_, count);
    }

    void reserve(std::size_t pairs) { pairs_.reserve(pairs); }

    void add(const NearPair &pair)
    {
        pairs_.push_back(pair);
        count_in(pair.first);
        count_in(pair.second);
    }

    /// The object has got another prediction or is gone: of its pairs only those count that are added from now on.
    void retire(ProxyId id, Tick now)
    {
        if (!members_.contains(id))
            return;
        // What came after the last time is not to be mixed up with what comes after this one.
        if (settled_ != pairs_.size())
            drop_stale(now);
        disturb(id);
        if (!is_retired_[id])
            retired_.push_back(id);
        is_retired_[id] = true;
    }

    /// The object has moved: its pairs must not rest.
    void disturb(ProxyId id)
    {
        if (!resting_.contains(id))
            return;
        disturbed_.insert(id);
        is_disturbed_ = true;
    }

    void disturb(const IdSet &ids)
    {
        if (together_.empty() && apart_.empty())
            return;
        for (std::size_t i = 0; i < ids.words(); ++i)
            IdSet::visit_word(i, ids.word(i) & resting_.word(i), [this](ProxyId id) { disturb(id); });
    }

    /// Has the pairs of all that were disturbed tested again.
    void wake_disturbed()
    {
        if (!is_disturbed_)
            return;
        wake_disturbed(together_);
        wake_disturbed(apart_);
        resting_ -= disturbed_;
        disturbed_.clear();
        is_disturbed_ = false;
    }

    /// Drops what is stale and calls visit(pair) for all others that are tested, and some time before that coming(pair). To
    /// be called when all that were disturbed have been woken.
    ///
    /// @return the visitor, which is not shared meanwhile: what it counts stays in registers.
    template <typename Coming, typename Visit> Visit visit_tested(Tick now, Coming coming, Visit visit)
    {
        if (may_have_stale(now))
            return drop_stale(now, coming, visit);
        const NearPair *const pairs = pairs_.data();
        for (std::size_t i = 0, count = pairs_.size(); i < count; ++i)
        {
            coming(later(pairs, count, i, soon));
            visit(pairs[i]);
        }
        return visit;
    }

    /// Lets pairs rest, as the verdict judge(pair) says, or be tested on. To be called when nothing is stale.
    template <typename Judge> void let_rest(Judge judge)
    {
        NearPair *left = pairs_.data();
        for (const NearPair &pair : pairs_)
        {
            const Verdict verdict = judge(pair);
            if (verdict == Verdict::open)
                *left++ = pair;
            else
                rest(verdict == Verdict::together ? together_ : apart_, pair);
        }
        settle(left);
    }

    void clear()
    {
        for (std::vector<NearPair> *pairs : {&pairs_, &together_, &apart_})
            pairs->clear();
        for (IdSet *set : {&members_, &resting_, &disturbed_})
            set->clear();
        forget_retired();
        settled_ = 0;
        is_disturbed_ = false;
        counts_.assign(counts_.size(), 0);
    }

    /// Calls visit(pair, verdict) for all that are not stale, whether they are tested or rest.
    template <typename Visit> void for_all(Visit visit) const
    {
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            if (i >= settled_ || !is_retired(pairs_[i]))
                visit(pairs_[i], Verdict::open);
        for_resting(together_, Verdict::together, visit);
        for_resting(apart_, Verdict::apart, visit);
    }

    /// Those that are tested at each tick; stale ones among them.
    const std::vector<NearPair> &pairs() const { return pairs_; }
    /// Those that rest and overlap. (Once what was disturbed has been woken.)
    const std::vector<NearPair> &together() const { return together_; }
    /// Who is in any pair.
    const IdSet &members() const { return members_; }

    std::size_t bytes() const
    {
        const std::size_t pairs = pairs_.capacity() + together_.capacity() + apart_.capacity();
        return pairs * sizeof(NearPair) + counts_.capacity() * sizeof(std::uint32_t) + members_.bytes() +
               resting_.bytes() + disturbed_.bytes() + retired_.capacity() * sizeof(ProxyId) + is_retired_.capacity();
    }

private:
    static constexpr std::size_t soon = 16; // in the time of so many tests, memory far away is fetched

    // Pairs have come or become stale since the last time, or have left each other.
    bool may_have_stale(Tick now) const
    {
        return !retired_.empty() || settled_ != pairs_.size() || ticks_between(now, next_leave_) < 0;
    }

    void drop_stale(Tick now)
    {
        wake_disturbed();
        const auto ignore = [](const NearPair &) {};
        drop_stale(now, ignore, ignore);
    }

    template <typename Coming, typename Visit> Visit drop_stale(Tick now, Coming coming, Visit visit)
    {
        NearPair *const pairs = pairs_.data(), *left = pairs;
        const std::size_t count = pairs_.size(), settled = settled_;
        std::int32_t next_leave = NearPair::for_long;
        for (std::size_t i = 0; i < count; ++i)
        {
            coming(later(pairs, count, i, soon));
            const NearPair pair = pairs[i];
            const std::int32_t ticks_left = pair.ticks_left(now);
            if (ticks_left < 0 || ((i < settled) & is_retired(pair)))
            {
                count_out(pair);
                continue;
            }
            next_leave = std::min(next_leave, ticks_left);
            visit(pair);
            if (left != &pairs[i]) // memory that is not written need not be written back
                *left = pair;
            ++left;
        }
        settle(left);
        forget_retired();
        next_leave_ = now + static_cast<Tick>(next_leave);
        return visit;
    }

    void settle(const NearPair *end)
    {
        pairs_.resize(static_cast<std::size_t>(end - pairs_.data()));
        settled_ = pairs_.size();
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

    void wake_disturbed(std::vector<NearPair> &pairs)
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

    template <typename Visit> void for_resting(const std::vector<NearPair> &pairs, Verdict verdict, Visit &visit) const
    {
        for (const NearPair &pair : pairs)
            if (!is_retired(pair))
                visit(pair, is_disturbed(pair) ? Verdict::open : verdict);
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

    std::vector<NearPair> pairs_;
    std::size_t settled_ = 0;                // so many have been there since stale ones were last dropped
    Tick next_leave_ = 0;                    // the last tick at which none of these has left
    std::vector<NearPair> together_, apart_; // those that rest
    IdSet members_;
    IdSet resting_;   // all in pairs that rest, and maybe some whose partners have been disturbed
    IdSet disturbed_; // of these
    bool is_disturbed_ = false;
    std::vector<ProxyId> retired_;         // since stale pairs were last dropped
    std::vector<std::uint8_t> is_retired_; // bytes, not bits: two are looked up for each pair
    std::vector<std::uint32_t> counts_;    // pairs that each proxy is in
};
} // namespace ode_predictive_space

#endif
