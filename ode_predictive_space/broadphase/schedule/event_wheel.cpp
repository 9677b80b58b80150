#include "ode_predictive_space/broadphase/schedule/event_wheel.h"

#include <utility>

#include "ode_predictive_space/broadphase/base/prefetch.h"

namespace ode_predictive_space
{
EventWheel::EventWheel() : buckets_(fine + turn, no_entries), sizes_(turn, 0) {}

void EventWheel::link(Index index)
{
    constexpr Tick turns_until_ticks_wrap = ~Tick{0} / turn + 1;
    const Tick due = pool_[index].due, in_turn = due / turn;
    const Tick turns_ahead = (in_turn - now_ / turn) % turns_until_ticks_wrap;
    const bool is_coarse = turns_ahead >= 2 && turns_ahead < turn;
    sizes_[in_turn % turn] += is_coarse;
    Index &head = turns_ahead < 2 ? buckets_[due % fine][index % lanes]
                  : is_coarse     ? coarse_bucket(in_turn)[index % lanes]
                                  : beyond_;
    pool_[index].next = head;
    head = index;
}

EventWheel::Index EventWheel::take_free_entry()
{
    if (free_list_ == none)
    {
        pool_.emplace_back();
        return static_cast<Index>(pool_.size() - 1);
    }
    const Index index = free_list_;
    free_list_ = pool_[index].next;
    --free_;
    return index;
}

void EventWheel::release(Index index)
{
    pool_[index].next = free_list_;
    free_list_ = index;
    ++free_;
}

void EventWheel::schedule(Tick due, const Event &event)
{
    const Index index = take_free_entry();
    pool_[index].event = event;
    pool_[index].due = due;
    link(index);
}

void EventWheel::link_all_beyond()
{
    for (Index index = std::exchange(beyond_, none); index != none;)
    {
        const Index next = pool_[index].next;
        link(index);
        index = next;
    }
}

// Events that are scheduled for the next turn from now on go to its ticks directly.
void EventWheel::spread_next_turn()
{
    const Tick next = now_ / turn + 1, ticks_left = turn - now_ % turn;
    Bucket &bucket = coarse_bucket(next);
    std::uint32_t &size = sizes_[next % turn];
    if (size == 0)
        return;
    std::uint32_t share = (size + ticks_left - 1) / ticks_left;
    size -= share;
    for (std::size_t lane = 0; share > 0; lane = (lane + 1) % lanes)
        if (const Index index = bucket[lane]; index != none)
        {
            bucket[lane] = pool_[index].next;
            fetch(bucket[lane]);
            link(index);
            --share;
        }
}

void EventWheel::advance(Tick now, std::vector<Event> &due)
{
    now_ = now;
    if (now % long_turn == 0)
        link_all_beyond();
    spread_next_turn();
    Bucket bucket = std::exchange(buckets_[now % fine], no_entries);
    while (bucket != no_entries)
        for (Index &index : bucket)
            if (index != none)
            {
                const Index taken = std::exchange(index, pool_[index].next);
                fetch(index);
                due.push_back(pool_[taken].event);
                release(taken);
            }
}

void EventWheel::fetch(Index index) const
{
    if (index != none)
        prefetch(&pool_[index]);
}

void EventWheel::restart(Tick now)
{
    now_ = now;
    // There are many buckets, and at the first tick they are empty.
    if (pool_.empty())
        return;
    buckets_.assign(buckets_.size(), no_entries);
    sizes_.assign(sizes_.size(), 0);
    beyond_ = none;
    pool_.clear();
    free_list_ = none;
    free_ = 0;
}

std::size_t EventWheel::bytes() const
{
    return bytes_of(buckets_) + bytes_of(sizes_) + bytes_of(pool_);
}
} // namespace ode_predictive_space
