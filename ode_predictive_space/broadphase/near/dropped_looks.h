// What is known of a pair outlives the envelopes of its objects: looks of pairs that were dropped, for those that come back.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_DROPPED_LOOKS_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_DROPPED_LOOKS_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ode_predictive_space/broadphase/base/ids.h"
#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/near/shape_test.h"

namespace ode_predictive_space
{
class DroppedLooks
{
public:
    bool empty() const { return entries_.empty(); }
    void add(const CandidatePair &pair, const Look &look) { entries_.push_back({pair, look}); }

    /// For find(), after the last add().
    void prepare()
    {
        std::size_t size = 16;
        while (size < 2 * entries_.size())
            size *= 2;
        table_.assign(size, 0);
        for (std::uint32_t i = 0; i < entries_.size(); ++i)
            table_[free_place(entries_[i].pair)] = i + 1;
    }

    /// The look of a pair, in whichever order its objects were; null when it was not dropped.
    const Look *find(const CandidatePair &pair)
    {
        for (std::size_t place = first_place(pair); table_[place] != 0; place = next(place))
            if (Entry &entry = entries_[table_[place] - 1]; is_same(entry.pair, pair))
            {
                if (entry.pair.first != pair.first)
                    turn_round(entry);
                return &entry.look;
            }
        return nullptr;
    }

    /// When all objects of a large scene get new envelopes at once, there are very many.
    void clear()
    {
        if (entries_.capacity() > tuning::kept_looks)
            release();
        entries_.clear();
    }
    void release()
    {
        free_memory(entries_);
        free_memory(table_);
    }
    std::size_t bytes() const { return bytes_of(entries_) + bytes_of(table_); }

private:
    struct Entry
    {
        CandidatePair pair;
        Look look;
    };

    static bool is_same(const CandidatePair &one, const CandidatePair &other)
    {
        return (one.first == other.first && one.second == other.second) ||
               (one.first == other.second && one.second == other.first);
    }

    static void turn_round(Entry &entry)
    {
        entry.pair = {entry.pair.second, entry.pair.first};
        for (float &coordinate : entry.look.axis)
            coordinate = -coordinate;
    }

    std::size_t next(std::size_t place) const { return (place + 1) & (table_.size() - 1); }
    std::size_t first_place(const CandidatePair &pair) const
    {
        const std::uint32_t mixed = (pair.first + pair.second) * 0x9e3779b1u ^ (pair.first ^ pair.second) * 0x85ebca6bu;
        return (mixed ^ mixed >> 15) & (table_.size() - 1);
    }
    std::size_t free_place(const CandidatePair &pair) const
    {
        std::size_t place = first_place(pair);
        while (table_[place] != 0)
            place = next(place);
        return place;
    }

    std::vector<Entry> entries_;
    std::vector<std::uint32_t> table_; // numbers among these, counted from 1; 0: none. A power of two of places
};
} // namespace ode_predictive_space

#endif
