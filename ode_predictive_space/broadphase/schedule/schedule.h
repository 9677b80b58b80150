// Third stage of the tick, second half: when can the candidate pairs come near each other?
//
// In: candidate pairs. Out: pairs that may be near now; the others sleep here until their time of proximity, and objects until
// the end of their horizons.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SCHEDULE_SCHEDULE_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SCHEDULE_SCHEDULE_H

#include <vector>

#include "ode_predictive_space/broadphase/base/batch.h"
#include "ode_predictive_space/broadphase/schedule/event_wheel.h"
#include "ode_predictive_space/broadphase/schedule/pair_proximity.h"

namespace ode_predictive_space
{
class Schedule
{
public:
    /// Moves the clock to `now`, which is the next tick: its events are due.
    void advance(Tick now) { wheel_.advance(now, due_); }
    bool has_due_events() const { return !due_.empty(); }

    /// Adds the objects whose horizons end now.
    void take_expired(const ProxyStore &proxies, Batch &batch) const;

    /// Notes the ends of the horizons of the batch.
    void expect_ends(const ProxyStore &proxies, const Batch &batch, Tick now);

    /// Sorts candidates into pairs that may be near now, pairs that sleep until their time, and pairs that need no further
    /// look (dropped).
    ///
    /// @param near where the first of these are appended.
    void classify(const ProxyStore &proxies, const std::vector<CandidatePair> &candidates, Tick now, ProximityTest test,
                  std::vector<NearPair> &near);

    /// Appends to `near` the pairs whose time has come, unless a newer prediction of either object has dealt with them.
    ///
    /// @return their number.
    std::size_t wake(const ProxyStore &proxies, Tick now, std::vector<NearPair> &near) const;

    /// Ends the update: due events have been dealt with. Purges stale events when there are many.
    void finish(const ProxyStore &proxies);

    /// Forgets all events and sets the clock.
    void restart(Tick now)
    {
        due_.clear();
        wheel_.restart(now);
    }

    /// The same, and gives their memory back.
    void release(Tick now)
    {
        restart(now);
        free_memory(due_);
        wheel_.release();
    }

    /// Pairs that sleep until their time of proximity.
    std::size_t pairs(const ProxyStore &proxies) const;

    std::size_t bytes() const { return wheel_.bytes() + bytes_of(due_); }

private:
    EventWheel wheel_;
    std::vector<Event> due_;
    std::size_t purge_at_ = tuning::least_purge;
};
} // namespace ode_predictive_space

#endif
