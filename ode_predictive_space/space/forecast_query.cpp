// Forecast queries: which geoms will meet, and when.

#include <algorithm>
#include <utility>

#include "ode_predictive_space/space/geom_shape.h"
#include "ode_predictive_space/space/predictive_space.h"

using namespace ode_predictive_space;

std::optional<double> dxPredictiveSpace::time_of_proximity(dxGeom *first, dxGeom *second, double *apart_until)
{
    GeomScene now = scene();
    const CandidatePair pair{proxy_of(first), proxy_of(second)};
    if (by_shape())
    {
        IdSet wanted;
        wanted.resize(geoms_.size());
        wanted.insert(pair.first);
        wanted.insert(pair.second);
        broadphase_.follow_shapes(now, wanted);
    }
    return time_of_proximity(pair, broadphase_.forecast(now, pair.first, ticks_), now, apart_until);
}

std::optional<double> dxPredictiveSpace::time_of_proximity(const CandidatePair &pair, const Forecast &first,
                                                           GeomScene &now, double *apart_until)
{
    const Forecast second = broadphase_.forecast(now, pair.second, ticks_);
    *apart_until = std::min(first.ticks, second.ticks);
    if (now.overlap(pair.first, pair.second) && (!by_shape() || broadphase_.may_touch(pair)))
        return 0.0;
    if (!first.known() || !second.known())
        return std::nullopt;
    const bool by_spheres = by_sphere() && !found_by_libccd(geoms_[pair.first], geoms_[pair.second]);
    const std::optional<double> earliest = broadphase_.time_of_proximity(first, second, by_spheres);
    if (!earliest || !by_shape())
        return earliest;
    const std::optional<double> contact = broadphase_.time_of_contact(first, second, pair);
    return contact ? std::optional<double>(std::max(*earliest, *contact)) : std::nullopt;
}

std::vector<dxPredictiveSpace::Encounter> dxPredictiveSpace::encounters(dxGeom *geom)
{
    const ProxyId self = proxy_of(geom);
    GeomScene now = scene();
    const IdSet &members = broadphase_.proxies().members();
    if (by_shape())
        broadphase_.follow_shapes(now, members);
    const Forecast own = broadphase_.forecast(now, self, ticks_);
    std::vector<std::pair<double, ProxyId>> times;
    members.for_each([&](ProxyId other) {
        double apart_until;
        const auto time = other == self ? std::nullopt : time_of_proximity({self, other}, own, now, &apart_until);
        if (time)
            times.emplace_back(*time, other);
    });
    std::sort(times.begin(), times.end()); // equal times are ordered by number, never by address
    std::vector<Encounter> met;
    for (const auto &[time, id] : times)
        met.push_back({geoms_[id], time});
    return met;
}
