// The near set: the pairs that may overlap now.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SET_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SET_H

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
/// disturbed.
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
    }

    void reserve(std::size_t pairs) { pairs_.reserve(pairs); }

    void add(const NearPair &pair)
    {
        pairs_.push_back(pair);
        count_in(pair.first);
        count_in(pair.second);
    }

    /// Calls visit(pair) for all that are tested, and some time before that coming(pair), if that is `wanted`.
    template <typename Coming, typename Visit> void for_each(bool wanted, Coming coming, Visit visit) const
    {
        constexpr std::size_t soon = 16; // in the time of so many tests, memory far away is fetched
        const NearPair *const pairs = pairs_.data();
        for (std::size_t i = 0, count = pairs_.size(); i < count; ++i)
        {
            if (wanted)
                coming(later(pairs, count, i, soon));
            visit(pairs[i]);
        }
    }

    /// Drops all of these for which keep(pair) is false.
    template <typename Coming, typename Keep> void keep_if(bool wanted, Coming coming, Keep keep)
    {
        NearPair *left = pairs_.data();
        for_each(wanted, coming, [&](const NearPair &pair) {
            if (keep(pair))
                *left++ = pair;
            else
            {
                count_out(pair.first);
                count_out(pair.second);
            }
        });
        pairs_.resize(static_cast<std::size_t>(left - pairs_.data()));
    }

    /// Lets pairs rest, as the verdict judge(pair) says, or be tested on.
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
        pairs_.resize(static_cast<std::size_t>(left - pairs_.data()));
    }

    /// The object has moved, got another prediction or is gone: its pairs must not rest.
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
    ///
    /// @return true when there may be any; stale ones may be among them.
    bool wake_disturbed()
    {
        if (!is_disturbed_)
            return false;
        wake_disturbed(together_);
        wake_disturbed(apart_);
        resting_ -= disturbed_;
        disturbed_.clear();
        is_disturbed_ = false;
        return true;
    }

    void clear()
    {
        for (std::vector<NearPair> *pairs : {&pairs_, &together_, &apart_})
            pairs->clear();
        for (IdSet *set : {&members_, &resting_, &disturbed_})
            set->clear();
        is_disturbed_ = false;
        counts_.assign(counts_.size(), 0);
    }

    /// Calls visit(pair, verdict) for all, whether they are tested or rest.
    template <typename Visit> void for_all(Visit visit) const
    {
        for (const NearPair &pair : pairs_)
            visit(pair, Verdict::open);
        for (const NearPair &pair : together_)
            visit(pair, is_disturbed(pair) ? Verdict::open : Verdict::together);
        for (const NearPair &pair : apart_)
            visit(pair, is_disturbed(pair) ? Verdict::open : Verdict::apart);
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
               resting_.bytes() + disturbed_.bytes();
    }

private:
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

    void wake_disturbed(std::vector<NearPair> &pairs)
    {
        NearPair *left = pairs.data();
        for (const NearPair &pair : pairs)
            if (is_disturbed(pair))
                pairs_.push_back(pair);
            else
                *left++ = pair;
        pairs.resize(static_cast<std::size_t>(left - pairs.data()));
    }

    void count_in(ProxyId id)
    {
        if (counts_[id]++ == 0)
            members_.insert(id);
    }

    void count_out(ProxyId id)
    {
        if (--counts_[id] == 0)
            members_.erase(id);
    }

    std::vector<NearPair> pairs_;
    std::vector<NearPair> together_, apart_; // those that rest
    IdSet members_;
    IdSet resting_;   // all in pairs that rest, and maybe some whose partners have been disturbed
    IdSet disturbed_; // of these
    bool is_disturbed_ = false;
    std::vector<std::uint32_t> counts_; // pairs that each proxy is in
};
} // namespace ode_predictive_space

#endif
