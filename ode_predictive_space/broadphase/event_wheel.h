// The event schedule: what is to happen at which tick.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_EVENT_WHEEL_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_EVENT_WHEEL_H

#include <array>
#include <cstddef>
#include <vector>

#include "ode_predictive_space/broadphase/types.h"

namespace ode_predictive_space
{
/// A pair's time of proximity, or the end of one object's horizon (then `second` is no_proxy).
///
/// It holds for the predictions that it was derived from: a newer generation of either object makes it stale. Stale events
/// stay where they are until their tick comes or purge() is called.
struct Event
{
    static constexpr std::int32_t stays = -1;

    ProxyId first;
    ProxyId second;
    Generation first_generation;
    Generation second_generation;
    std::int32_t stay = stays; ///< ticks after which the pair has parted again; `stays` when it is near to the end
};

/// A hierarchical timing wheel: a bucket per tick for this turn and the next, coarser ones, of a turn each, for what comes
/// later, and one list for all that lies beyond. While a turn passes, the coarse bucket of the next is spread over its ticks,
/// as many events at each of them. So no tick has to deal with all.
class EventWheel
{
public:
    EventWheel();

    /// @param due later than the tick of the last advance().
    void schedule(Tick due, const Event &event);

    /// Moves the clock to `now`, which is the next tick, and appends to `due` the events of that tick.
    void advance(Tick now, std::vector<Event> &due);

    /// Calls visit(event) for all events, stale ones too.
    template <typename Visit> void for_each(Visit visit) const;

    /// Drops all events for which keep(event) is false.
    template <typename Keep> void purge(Keep keep);

    /// Forgets all events.
    void clear();

    /// Forgets all events and sets the clock.
    void restart(Tick now)
    {
        clear();
        now_ = now;
    }

    std::size_t size() const { return pool_.size() - free_; }
    std::size_t bytes() const;

private:
    using Index = std::uint32_t;
    static constexpr Index none = ~Index{0};
    static constexpr Tick turn = 64;               // in ticks: what one coarse bucket holds
    static constexpr Tick long_turn = turn * turn; // of the coarse buckets
    static constexpr Tick fine = 2 * turn;         // ticks that have a bucket each

    struct Entry
    {
        Event event;
        Tick due;
        Index next;
    };

    /// Lists that are walked side by side, so that the processor can wait for several entries at once.
    static constexpr std::size_t lanes = 4;
    using Bucket = std::array<Index, lanes>;
    static constexpr Bucket no_entries = {none, none, none, none};

    Bucket &coarse_bucket(Tick in_turn) { return buckets_[fine + in_turn % turn]; }
    void fetch(Index index) const;
    Index take_free_entry();
    void release(Index index);
    void link(Index index);
    void link_all_beyond();
    void spread_next_turn();

    std::vector<Bucket> buckets_;      // fine, coarse
    std::vector<std::uint32_t> sizes_; // of the coarse ones
    Index beyond_ = none;
    std::vector<Entry> pool_;
    Index free_list_ = none;
    std::size_t free_ = 0;
    Tick now_ = 0;
};

template <typename Visit> void EventWheel::for_each(Visit visit) const
{
    auto walk = [&](Index index) {
        for (; index != none; index = pool_[index].next)
            visit(pool_[index].event);
    };
    for (const Bucket &bucket : buckets_)
        for (Index head : bucket)
            walk(head);
    walk(beyond_);
}

template <typename Keep> void EventWheel::purge(Keep keep)
{
    // Takes them out of a list that begins with `*place`; returns how many these were.
    auto purge_list = [&](Index *place) {
        std::uint32_t count = 0;
        while (*place != none)
            if (const Index index = *place; keep(pool_[index].event))
                place = &pool_[index].next;
            else
            {
                *place = pool_[index].next;
                release(index);
                ++count;
            }
        return count;
    };
    for (std::size_t i = 0; i < buckets_.size(); ++i)
        for (Index &head : buckets_[i])
        {
            const std::uint32_t count = purge_list(&head);
            if (i >= fine)
                sizes_[i - fine] -= count;
        }
    purge_list(&beyond_);
}
} // namespace ode_predictive_space

#endif
