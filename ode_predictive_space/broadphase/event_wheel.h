// The event schedule: what is to happen at which tick.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_EVENT_WHEEL_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_EVENT_WHEEL_H

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

    Index &coarse_bucket(Tick in_turn) { return buckets_[fine + in_turn % turn]; }
    Index take_free_entry();
    void release(Index index);
    void link(Index index);
    void link_all_beyond();
    void spread_next_turn();

    std::vector<Index> buckets_;       // fine, coarse
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
    for (Index head : buckets_)
        walk(head);
    walk(beyond_);
}

template <typename Keep> void EventWheel::purge(Keep keep)
{
    std::vector<Entry> kept;
    auto collect = [&](Index head) {
        for (Index index = head; index != none; index = pool_[index].next)
            if (keep(pool_[index].event))
                kept.push_back(pool_[index]);
    };
    for (Index head : buckets_)
        collect(head);
    collect(beyond_);
    clear();
    // Lists are filled from the front: going backwards leaves the events in the order they had.
    for (auto entry = kept.rbegin(); entry != kept.rend(); ++entry)
        schedule(entry->due, entry->event);
}
} // namespace ode_predictive_space

#endif
