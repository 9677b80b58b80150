// First stage of the tick: is every object that may have left its envelope still inside?

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_VERIFY_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_VERIFY_H

#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/id_set.h"
#include "ode_predictive_space/broadphase/proxy_store.h"

namespace ode_predictive_space
{
/// |x - s(t)| <= R(t) along each axis. False when anything is NaN.
///
/// A still envelope has a path and a deviation that are constant whatever the time.
inline bool centre_inside(const PackedPath &path, const Vector3 &centre, Tick now)
{
    const double t = ticks_between(path.since, now);
    const double half_t = 0.5 * t;
    const double reach = path.deviation[0] + t * (path.deviation[1] + t * double{path.deviation[2]});
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double predicted = path.position[axis] + t * (path.velocity[axis] + half_t * path.acceleration[axis]);
        inside &= std::abs(centre[axis] - predicted) <= reach;
    }
    return inside;
}

/// Is the box within the envelope? A side that is NaN is so only where the envelope is infinite.
inline bool bounds_inside(const Envelope &envelope_now, const Box &box)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Box allowed = envelope_now.at(0);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
    {
        inside &= allowed.min()[axis] <= box.min()[axis] || allowed.min()[axis] == -infinity;
        inside &= box.max()[axis] <= allowed.max()[axis] || allowed.max()[axis] == infinity;
    }
    return inside;
}

/// The check of those that have no sphere, or are predicted by tight bounds.
template <typename Scene> bool bounds_hold(Scene &scene, const ProxyStore &proxies, ProxyId id, Tick now)
{
    const PackedBounds &bounds = proxies.bounds[id];
    // What no tree can hold is predicted anew whenever it moves: it may have become finite again.
    return bounds.check == Check::bounds && bounds.shelf != Shelf::unbounded &&
           bounds_inside(proxies.envelope(id, now), scene.bounds(id));
}

/// Is the object where its prediction says, so that it need not be predicted anew?
///
/// @tparam Scene gives position(id), has_grown(id, radius) and bounds(id) of an object as they are now.
template <typename Scene> bool prediction_holds(Scene &scene, const ProxyStore &proxies, ProxyId id, Tick now)
{
#ifdef ODE_PREDICTIVE_SPACE_WITHOUT_VERIFY
    // Only for the test which shows that the differential test notices when predictions are trusted blindly.
    return proxies.bounds[id].check != Check::none;
#endif
    const float radius = proxies.centre_radius[id];
    if (radius < 0)
        return bounds_hold(scene, proxies, id, now);
    return centre_inside(proxies.paths[id], scene.position(id), now) & !scene.has_grown(id, radius);
}
} // namespace ode_predictive_space

#endif
