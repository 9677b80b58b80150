// Events by tick. In: events and when they are due. Out: at each tick those that are due.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SCHEDULE_EVENT_WHEEL_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SCHEDULE_EVENT_WHEEL_H

#include <array>
#include <cstddef>
#include <vector>

#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/schedule/pairs.h"

namespace ode_predictive_space
{
/// A hierarchical timing wheel (Varghese and Lauck 1987): a bucket per tick for this turn and the next, a coarse bucket per turn
/// for later events, and one list for all beyond. While a turn passes, the coarse bucket of the next turn is spread over its
/// ticks, an equal share at each tick, so that no tick has to relink all.
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

    /// Forgets all events and sets the clock.
    void restart(Tick now);

    /// Gives back the memory of events, of which there are none.
    void release() { pool_.shrink_to_fit(); }

    std::size_t size() const { return pool_.size() - free_; }
    std::size_t bytes() const;

private:
    using Index = std::uint32_t;
    static constexpr Index none = ~Index{0};
    static constexpr Tick turn = 64;               // ticks of one coarse bucket
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
