#include "ode_predictive_space/broadphase/assess.h"

#include <algorithm>
#include <cmath>

#include "ode_predictive_space/broadphase/approach.h"

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

// Both boxes and spheres must be near: not before the later of the two first times.
std::optional<ProximityInterval> with_spheres(const ProximityInterval &boxes, const ProxyStore &proxies, ProxyId first,
                                              ProxyId second, Tick now)
{
    const std::optional<double> time = sphere_time_of_proximity(spherical(proxies.outer_envelope(first, now)),
                                                                spherical(proxies.outer_envelope(second, now)),
                                                                proxies.common_horizon(first, second, now));
    if (!time)
        return std::nullopt;
    return ProximityInterval{std::max(boxes.enter, *time), boxes.leave};
}
} // namespace

std::optional<ProximityInterval> proximity(const ProxyStore &proxies, ProxyId first, ProxyId second, Tick now,
                                           Proximity measure)
{
    const std::optional<ProximityInterval> boxes =
        box_proximity(proxies.outer_envelope(first, now), proxies.outer_envelope(second, now),
                      proxies.common_horizon(first, second, now));
    return boxes && measure == Proximity::sphere ? with_spheres(*boxes, proxies, first, second, now) : boxes;
}

void assess(const ProxyStore &proxies, const std::vector<CandidatePair> &candidates, Tick now, Proximity measure,
            std::vector<NearPair> &near, std::vector<ScheduledPair> &scheduled)
{
    std::optional<Approach> approach;
    ProxyId last = no_proxy;
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
        proxies.prefetch(later(candidates, i).second);
        const CandidatePair &pair = candidates[i];
        // Candidates come by the object that was predicted.
        if (pair.first != last)
            approach.emplace(proxies, last = pair.first, now);
        std::optional<ProximityInterval> interval = approach->to(pair.second);
        if (interval && measure == Proximity::sphere)
            interval = with_spheres(*interval, proxies, pair.first, pair.second, now);
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
