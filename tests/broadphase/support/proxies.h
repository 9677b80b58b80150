// Predictions made by hand, for tests of what is derived from them.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_PROXIES_H
#define ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_PROXIES_H

#include "ode_predictive_space/broadphase/objects/proxy_store.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
/// Adds a ball of this radius, checked by its centre, whose envelope is valid for `ticks` from `since` on.
inline ProxyId add_proxy(ProxyStore &store, const Path &path, const Deviation &deviation, double radius, Tick since,
                         Tick ticks)
{
    const ProxyId id = store.add();
    PackedPath &packed = store.paths[id];
    ProxyRecord::Prediction &prediction = store.records[id].prediction;
    packed.set_path(path);
    for (int axis = 0; axis < 3; ++axis)
    {
        prediction.low[axis] = round_down(-radius);
        prediction.high[axis] = round_up(radius);
    }
    packed.set_deviation({round_up(deviation.a), round_up(deviation.b), round_up(deviation.c)});
    packed.since = since;
    prediction.radius = round_up(radius);
    prediction.until = since + ticks;
    store.records[id].kind.check = Check::centre;
    store.stamps[id].radius = prediction.radius;
    return id;
}

/// Lets a proxy be checked by its bounds instead of its centre.
inline void check_by_bounds(ProxyStore &store, ProxyId id)
{
    store.records[id].kind.check = Check::bounds;
    store.stamps[id].radius = -1;
}

/// Adds a ball that stays where it is, give or take `slack`.
inline ProxyId add_still_proxy(ProxyStore &store, const Vector3 &centre, double radius, double slack)
{
    const ProxyId id = add_proxy(store, {centre, Vector3::Zero(), Vector3::Zero()}, {slack, 0, 0}, radius, 0, 0);
    store.records[id].kind.still = true;
    return id;
}

/// Adds a proxy that moves at random, or not, near the origin, at `now`.
inline ProxyId add_random_proxy(ProxyStore &store, Random &random, double spread, Tick now)
{
    const double radius = random.uniform(0.01, 0.3);
    if (random.chance(0.3))
        return add_still_proxy(store, random.vector(spread), radius, random.uniform(0, 0.05));
    const Path path = {random.vector(spread), random.vector(0.05), random.vector(0.002)};
    const Deviation deviation = {random.uniform(0, 0.02), random.uniform(0, 0.01), random.uniform(0, 0.0005)};
    return add_proxy(store, path, deviation, radius, now, 1 + static_cast<Tick>(random.index(60)));
}
} // namespace ode_predictive_space

#endif
