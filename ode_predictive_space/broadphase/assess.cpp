#include "ode_predictive_space/broadphase/assess.h"

#include <algorithm>
#include <cmath>

#include "ode_predictive_space/prediction/proximity.h"

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
} // namespace

std::optional<double> time_of_proximity(const ProxyStore &proxies, ProxyId first, ProxyId second, Tick now,
                                        Proximity measure)
{
    const bool both_still = proxies.bounds[first].still && proxies.bounds[second].still;
    const double duration = both_still ? 0 : std::min(proxies.remaining(first, now), proxies.remaining(second, now));
    const Envelope one = proxies.outer_envelope(first, now);
    const Envelope other = proxies.outer_envelope(second, now);
    std::optional<double> time = box_time_of_proximity(one, other, duration);
    if (time && measure == Proximity::sphere)
    {
        // Both must be near: not before the later of the two first times.
        const std::optional<double> sphere_time = sphere_time_of_proximity(spherical(one), spherical(other), duration);
        if (!sphere_time)
            return std::nullopt;
        time = std::max(*time, *sphere_time);
    }
    return time;
}

void assess(const ProxyStore &proxies, const std::vector<CandidatePair> &candidates, Tick now, Proximity measure,
            std::vector<NearPair> &near, std::vector<ScheduledPair> &scheduled)
{
    for (const CandidatePair &pair : candidates)
    {
        const std::optional<double> time = time_of_proximity(proxies, pair.first, pair.second, now, measure);
        if (!time)
            continue;
        const Generation first = proxies.generations[pair.first];
        const Generation second = proxies.generations[pair.second];
        // Objects are looked at at whole ticks only.
        const double ticks = std::ceil(*time);
        if (ticks < 1)
            near.push_back({pair.first, pair.second, first, second, false, false});
        else
            scheduled.push_back({static_cast<std::int32_t>(ticks), {pair.first, pair.second, first, second}});
    }
}
} // namespace ode_predictive_space
