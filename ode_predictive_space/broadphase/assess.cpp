#include "ode_predictive_space/broadphase/assess.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space
{
namespace
{
// Verification keeps each coordinate within the deviation; a sphere needs the distance.
Envelope spherical(Envelope envelope)
{
    constexpr double root_of_3 = 1.7320508075688774;
    envelope.deviation.a *= root_of_3;
    envelope.deviation.b *= root_of_3;
    envelope.deviation.c *= root_of_3;
    return envelope;
}

// Ticks that may pass, from now on.
double common_horizon(const ProxyStore &proxies, ProxyId first, ProxyId second, Tick now)
{
    const bool both_still = proxies.bounds[first].still && proxies.bounds[second].still;
    return both_still ? 0 : std::min(proxies.remaining(first, now), proxies.remaining(second, now));
}

std::optional<ProximityInterval> proximity_of(const Envelope &one, const Envelope &other, double duration,
                                              Proximity measure)
{
    std::optional<ProximityInterval> interval = box_proximity(one, other, duration);
    if (interval && measure == Proximity::sphere)
    {
        // Both must be near: not before the later of the two first times.
        const std::optional<double> time = sphere_time_of_proximity(spherical(one), spherical(other), duration);
        if (!time)
            return std::nullopt;
        interval->enter = std::max(interval->enter, *time);
    }
    return interval;
}
} // namespace

std::optional<ProximityInterval> proximity(const ProxyStore &proxies, ProxyId first, ProxyId second, Tick now,
                                           Proximity measure)
{
    return proximity_of(proxies.outer_envelope(first, now), proxies.outer_envelope(second, now),
                        common_horizon(proxies, first, second, now), measure);
}

void assess(const ProxyStore &proxies, const std::vector<CandidatePair> &candidates, Tick now, Proximity measure,
            std::vector<NearPair> &near, std::vector<ScheduledPair> &scheduled)
{
    ProxyId last = no_proxy;
    Envelope envelope;
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
        proxies.prefetch(later(candidates, i).second);
        const CandidatePair &pair = candidates[i];
        // Candidates come by the object that was predicted.
        if (pair.first != last)
        {
            last = pair.first;
            envelope = proxies.outer_envelope(last, now);
        }
        const std::optional<ProximityInterval> interval =
            proximity_of(envelope, proxies.outer_envelope(pair.second, now),
                         common_horizon(proxies, pair.first, pair.second, now), measure);
        if (!interval)
            continue;
        // Objects are looked at at whole ticks only.
        const auto begin = static_cast<std::int32_t>(std::ceil(interval->enter));
        const bool leaves = std::isfinite(interval->leave);
        const std::int32_t stay =
            leaves ? static_cast<std::int32_t>(std::floor(interval->leave)) - begin : Event::stays;
        if (leaves && stay < 0)
            continue;
        const Event event{pair.first, pair.second, proxies.generations[pair.first], proxies.generations[pair.second],
                          stay};
        if (begin < 1)
            near.push_back(NearPair::of(event, now));
        else
            scheduled.push_back({begin, event});
    }
}
} // namespace ode_predictive_space
