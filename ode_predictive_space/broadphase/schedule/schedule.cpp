#include "ode_predictive_space/broadphase/schedule/schedule.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ode_predictive_space
{
namespace
{
bool is_current(const ProxyStore &proxies, const Event &event)
{
    return proxies.current(event.first, event.first_generation) &&
           (event.is_end_of_horizon() || proxies.current(event.second, event.second_generation));
}
} // namespace

void Schedule::take_expired(const ProxyStore &proxies, Batch &batch) const
{
    for (const Event &event : due_)
        if (event.is_end_of_horizon() && is_current(proxies, event))
            batch.add(event.first);
}

void Schedule::expect_ends(const ProxyStore &proxies, const Batch &batch, Tick now)
{
    for (ProxyId id : batch.ids())
        if (const Tick until = proxies.records[id].prediction.until; until != now)
            wheel_.schedule(until, {id, no_proxy, proxies.generations[id], 0});
}

void Schedule::classify(const ProxyStore &proxies, const std::vector<CandidatePair> &candidates, Tick now,
                        ProximityTest test, std::vector<NearPair> &near)
{
    std::optional<PairProximity> proximity;
    ProxyId last = no_proxy;
    const auto classify_pair = [&](std::size_t i) {
        const CandidatePair &pair = candidates[i];
        // Candidates come by the object that was predicted.
        if (pair.first != last)
            proximity.emplace(proxies, last = pair.first, now, test);
        const std::optional<ProximityInterval> interval = proximity->to(pair.second);
        if (!interval)
            return;
        // Objects are looked at at whole ticks only.
        const auto begin = static_cast<std::int32_t>(std::ceil(interval->enter));
        const bool leaves = std::isfinite(interval->leave);
        const std::int32_t stay =
            leaves ? static_cast<std::int32_t>(std::floor(interval->leave)) - begin : Event::stays;
        if (leaves && stay < 0)
            return;
        const Event event{pair.first, pair.second, proxies.generations[pair.first], proxies.generations[pair.second],
                          stay};
        if (begin < 1)
            near.push_back(NearPair::of(event, now));
        else
            wheel_.schedule(now + static_cast<Tick>(begin), event);
    };
    for_each_prefetched(candidates.size(), tuning::turns_ahead, classify_pair,
                        [&](std::size_t i) { proxies.prefetch(candidates[i].second); });
}

std::size_t Schedule::wake(const ProxyStore &proxies, Tick now, std::vector<NearPair> &near) const
{
    const std::size_t before = near.size();
    for (const Event &event : due_)
        if (!event.is_end_of_horizon() && is_current(proxies, event))
            near.push_back(NearPair::of(event, now));
    return near.size() - before;
}

// Where many predictions break early, stale events would pile up.
void Schedule::finish(const ProxyStore &proxies)
{
    clear_scratch(due_);
    if (wheel_.size() < purge_at_)
        return;
    wheel_.purge([&](const Event &event) { return is_current(proxies, event); });
    purge_at_ = std::max(tuning::least_purge, 2 * wheel_.size());
}

std::size_t Schedule::pairs(const ProxyStore &proxies) const
{
    std::size_t count = 0;
    wheel_.for_each([&](const Event &event) { count += !event.is_end_of_horizon() && is_current(proxies, event); });
    return count;
}
} // namespace ode_predictive_space
