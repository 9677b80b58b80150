// The near set: the pairs that are tested at each tick.

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
class NearSet
{
public:
    /// Makes room for proxies 0 to count - 1.
    void resize(std::size_t count)
    {
        members_.resize(count);
        grow(counts_, count);
    }

    void reserve(std::size_t pairs) { pairs_.reserve(pairs); }

    void add(const NearPair &pair)
    {
        pairs_.push_back(pair);
        count_in(pair.first);
        count_in(pair.second);
    }

    /// Calls visit(pair) for all, and some time before that coming(pair).
    template <typename Coming, typename Visit> void for_each(Coming coming, Visit visit) const
    {
        const NearPair *const pairs = pairs_.data();
        for (std::size_t i = 0, count = pairs_.size(); i < count; ++i)
        {
            coming(later(pairs, count, i, 16));
            visit(pairs[i]);
        }
    }

    /// Drops all pairs for which keep(pair) is false.
    template <typename Coming, typename Keep> void keep_if(Coming coming, Keep keep)
    {
        NearPair *left = pairs_.data();
        for_each(coming, [&](const NearPair &pair) {
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

    void clear()
    {
        pairs_.clear();
        members_.clear();
        counts_.assign(counts_.size(), 0);
    }

    const std::vector<NearPair> &pairs() const { return pairs_; }
    const IdSet &members() const { return members_; }

    std::size_t bytes() const
    {
        return pairs_.capacity() * sizeof(NearPair) + counts_.capacity() * sizeof(std::uint32_t) + members_.bytes();
    }

private:
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
    IdSet members_;
    std::vector<std::uint32_t> counts_; // pairs that each proxy is in
};
} // namespace ode_predictive_space

#endif
