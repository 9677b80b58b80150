// Third stage of the tick: when can the pairs that were found come near each other?

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_ASSESS_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_ASSESS_H

#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/event_wheel.h"
#include "ode_predictive_space/broadphase/proxy_store.h"
#include "ode_predictive_space/prediction/proximity.h"

namespace ode_predictive_space
{
/// What counts as near.
enum class Proximity
{
    box,   ///< bounding boxes overlap
    sphere ///< bounding boxes and bounding spheres overlap
};

/// A pair that is tested every tick, as long as neither object has been predicted anew and they have not left each other.
struct NearPair : CandidatePair
{
    /// Last tick at which they may be near; to_the_end when they do not part before the first of both horizons ends.
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

    /// Ticks from `now` on until it leaves; negative when it has left, for_long when it stays.
    /// (Without a branch: pairs of both kinds come at random.)
    std::int32_t ticks_left(Tick now) const
    {
        const std::int32_t stays = -static_cast<std::int32_t>(until == to_the_end);
        return (ticks_between(now, until) & ~stays) | (for_long & stays);
    }
};

/// A pair's time of proximity, counted from now on.
struct ScheduledPair
{
    std::int32_t ticks;
    Event event;
};

/// When two proxies may be near from `now` on, within the horizons of both; none when they stay apart that long.
std::optional<ProximityInterval> proximity(const ProxyStore &proxies, ProxyId first, ProxyId second, Tick now,
                                           Proximity measure);

/// Sorts candidates into those that may be near now, those that sleep until their time, and those that
/// need not be looked at (dropped).
void assess(const ProxyStore &proxies, const std::vector<CandidatePair> &candidates, Tick now, Proximity measure,
            std::vector<NearPair> &near, std::vector<ScheduledPair> &scheduled);
} // namespace ode_predictive_space

#endif
