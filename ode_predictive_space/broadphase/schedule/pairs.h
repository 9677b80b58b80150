// What becomes of a candidate pair: an event in the schedule, or a near pair.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SCHEDULE_PAIRS_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SCHEDULE_PAIRS_H

#include "ode_predictive_space/broadphase/base/ids.h"

namespace ode_predictive_space
{
/// A pair's time of proximity, or the end of one object's horizon (then `second` is no_proxy).
///
/// It holds for the predictions that it was derived from: a newer generation of either object makes it stale. Stale events
/// stay where they are until their tick comes or they are purged.
struct Event
{
    static constexpr std::int32_t stays = -1;

    ProxyId first;
    ProxyId second;
    Generation first_generation;
    Generation second_generation;
    std::int32_t stay = stays; ///< ticks after which the pair has parted again; `stays` when it is near to the end

    bool is_end_of_horizon() const { return second == no_proxy; }
};

/// A pair that is tested every tick, until one of its objects is predicted anew or they have left each other.
struct NearPair : CandidatePair
{
    /// Last tick at which the pair may be near; to_the_end when it does not part before the first of both horizons ends.
    Tick until;

    static constexpr Tick to_the_end = 0;

    static NearPair of(const Event &event, Tick now)
    {
        const Tick parting = now + static_cast<Tick>(event.stay);
        // The tick whose number means to_the_end is replaced by the next one.
        const Tick until = event.stay == Event::stays ? to_the_end : parting + (parting == to_the_end);
        return {{event.first, event.second}, until};
    }

    static constexpr std::int32_t for_long = std::int32_t{1} << 30;

    /// Ticks from `now` on until the pair leaves; negative when it has left, for_long when it stays.
    std::int32_t ticks_left(Tick now) const { return until == to_the_end ? for_long : ticks_between(now, until); }
};
} // namespace ode_predictive_space

#endif
