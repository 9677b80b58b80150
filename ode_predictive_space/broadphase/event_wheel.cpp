#include "ode_predictive_space/broadphase/event_wheel.h"

#include <utility>

namespace ode_predictive_space
{
EventWheel::EventWheel() : buckets_(bucket_count, none) {}

EventWheel::Index &EventWheel::bucket(Tick due)
{
    const std::int32_t ahead = ticks_between(now_, due);
    if (ahead < static_cast<std::int32_t>(turn))
        return buckets_[due % turn];
    return ahead < static_cast<std::int32_t>(long_turn) ? buckets_[turn + due / turn % turn] : beyond_;
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

void EventWheel::link(Index index)
{
    Index &head = bucket(pool_[index].due);
    pool_[index].next = head;
    head = index;
}

void EventWheel::schedule(Tick due, const Event &event)
{
    const Index index = take_free_entry();
    pool_[index].event = event;
    pool_[index].due = due;
    link(index);
}

void EventWheel::link_all_of(Index &head)
{
    for (Index index = std::exchange(head, none); index != none;)
    {
        const Index next = pool_[index].next;
        link(index);
        index = next;
    }
}

void EventWheel::advance(Tick now, std::vector<Event> &due)
{
    now_ = now;
    if (now % long_turn == 0)
        link_all_of(beyond_);
    if (now % turn == 0)
        link_all_of(buckets_[turn + now / turn % turn]);
    for (Index index = std::exchange(buckets_[now % turn], none); index != none;)
    {
        const Index next = pool_[index].next;
        due.push_back(pool_[index].event);
        release(index);
        index = next;
    }
}

void EventWheel::clear()
{
    buckets_.assign(bucket_count, none);
    beyond_ = none;
    pool_.clear();
    free_list_ = none;
    free_ = 0;
}

std::size_t EventWheel::bytes() const
{
    return buckets_.capacity() * sizeof(Index) + pool_.capacity() * sizeof(Entry);
}
} // namespace ode_predictive_space
