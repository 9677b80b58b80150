// First stage of the tick: is every object that may have left its envelope still inside?

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_VERIFY_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_VERIFY_H

#include <cmath>
#include <limits>

#include "ode_predictive_space/broadphase/id_set.h"
#include "ode_predictive_space/broadphase/measured_box.h"
#include "ode_predictive_space/broadphase/proxy_store.h"

namespace ode_predictive_space
{
/// |x - s(t)| <= R(t) along each axis. False when anything is NaN.
///
/// Evaluated in single precision relative to the position of the path; what that may add or hide is part of
/// ProxyStore::outer_envelope(). A still envelope has a path and a deviation that are constant whatever the time.
template <typename Real> inline bool centre_inside(const PackedPath &path, const Real *centre, Tick now)
{
    const float t = static_cast<float>(ticks_between(path.since, now));
    const double reach = path.reach(t);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
    {
        const float moved = t * (path.velocity[axis] + t * path.half_acceleration[axis]);
        inside &= std::abs(centre[axis] - (path.position[axis] + moved)) <= reach;
    }
    return inside;
}

#if defined(__SSE2__)
/// How far the path has come along each axis after t, and in the fourth component what the deviation has grown by.
inline __m128 moved_and_grown(const PackedPath &path, float t)
{
    const __m128 rate = _mm_load_ps(path.velocity), bend = _mm_load_ps(path.half_acceleration), times = _mm_set1_ps(t);
    return _mm_mul_ps(times, _mm_add_ps(rate, _mm_mul_ps(times, bend)));
}

/// R(t) in each component.
inline __m128 reach_on_all_axes(const PackedPath &path, __m128 moved_and_grown)
{
    return _mm_add_ps(_mm_set1_ps(path.deviation_base), _mm_shuffle_ps(moved_and_grown, moved_and_grown, 0xff));
}

/// |x| in each component; shifts need no constant.
inline __m128 magnitude(__m128 values)
{
    return _mm_castsi128_ps(_mm_srli_epi32(_mm_slli_epi32(_mm_castps_si128(values), 1), 1));
}

/// The same in a few vector instructions.
template <> inline bool centre_inside<double>(const PackedPath &path, const double *centre, Tick now)
{
    const __m128 moved = moved_and_grown(path, static_cast<float>(ticks_between(path.since, now)));
    // One by one: they may have been stored so a moment ago, and a wider load would have to wait for the stores.
    const __m128d xy = _mm_sub_pd(_mm_loadh_pd(_mm_load_sd(centre), centre + 1), _mm_load_pd(path.position));
    const __m128d z = _mm_sub_sd(_mm_load_sd(centre + 2), _mm_load_sd(path.position + 2));
    const __m128 come = _mm_movelh_ps(_mm_cvtpd_ps(xy), _mm_cvtpd_ps(z));
    // The fourth component, what the deviation has grown by, is no more than all of it.
    const __m128 inside = _mm_cmple_ps(magnitude(_mm_sub_ps(come, moved)), reach_on_all_axes(path, moved));
    return _mm_movemask_ps(inside) == 15;
}
#endif

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

/// The same for a packed envelope, evaluated as centre_inside() does it.
inline bool bounds_inside(const PackedPath &path, const PackedBounds &bounds, const Box &box, Tick now)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float t = bounds.still ? 0 : static_cast<float>(ticks_between(path.since, now));
    const double reach = path.reach(t);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double centre = path.position[axis] + t * (path.velocity[axis] + t * path.half_acceleration[axis]);
        inside &= (centre + bounds.low[axis] - reach <= box.min()[axis]) | (bounds.low[axis] == -infinity);
        inside &= (box.max()[axis] <= centre + bounds.high[axis] + reach) | (bounds.high[axis] == infinity);
    }
    return inside;
}

/// The same by single precision: false, too, when it is too close to tell.
inline bool surely_inside([[maybe_unused]] const PackedPath &path, [[maybe_unused]] const PackedBounds &bounds,
                          [[maybe_unused]] const MeasuredBox &box, [[maybe_unused]] Tick now)
{
#if defined(__SSE2__)
    const float t = bounds.still ? 0 : static_cast<float>(ticks_between(path.since, now));
    const __m128d xy = _mm_loadu_pd(path.position), z = _mm_load_sd(path.position + 2);
    const __m128 moved = moved_and_grown(path, t);
    const __m128 position = _mm_movelh_ps(_mm_cvtpd_ps(xy), _mm_cvtpd_ps(z));
    const __m128 reach = reach_on_all_axes(path, moved);
    const __m128 centre = _mm_add_ps(position, moved);
    const __m128 low = _mm_sub_ps(_mm_add_ps(centre, _mm_loadu_ps(bounds.low)), reach);
    const __m128 high = _mm_add_ps(_mm_add_ps(centre, _mm_loadu_ps(bounds.high)), reach);
    const __m128 size =
        _mm_add_ps(_mm_add_ps(magnitude(position), magnitude(moved)), _mm_add_ps(magnitude(low), magnitude(high)));
    const __m128 rounding = _mm_mul_ps(size, _mm_set1_ps(4 * std::numeric_limits<float>::epsilon()));
    return box.inside(_mm_add_ps(low, rounding), _mm_sub_ps(high, rounding)) && !bounds.unbounded;
#else
    return false;
#endif
}

/// The check of those that have no sphere, or are predicted by tight bounds.
template <typename Scene>
[[gnu::noinline]] bool bounds_hold(Scene &scene, const ProxyStore &proxies, ProxyId id, Tick now)
{
    const PackedBounds &bounds = proxies.bounds[id];
    // What no tree can hold is predicted anew whenever it moves: it may have become finite again.
    return bounds.check == Check::bounds && !bounds.unbounded &&
           bounds_inside(proxies.paths[id], bounds, scene.bounds(id), now);
}

/// The check at the notice of a move, when the object has just been written and lies in the cache: is its centre where it
/// should be at the tick `then`? False means that it takes a closer look: for those that are checked by their bounds, and
/// for those whose position has to be computed first.
///
/// Whatever changes an object is noticed by itself. So its size has to be looked at only when its pose is the one that the
/// last notice found, or when that is not known.
///
/// @tparam Object gives has_centre(), coordinates(), pose_digest() and has_grown(radius); see Broadphase::notice_move().
template <typename Object> inline bool notice_holds(ProxyStore &proxies, ProxyId id, const Object &object, Tick then)
{
    Stamp &stamp = proxies.stamps[id];
    if (std::signbit(stamp.radius) || !object.has_centre())
    {
        stamp.pose = 0;
        return false;
    }
    const std::uint32_t last = stamp.pose, pose = object.pose_digest();
    stamp.pose = pose;
    return centre_inside(proxies.paths[id], object.coordinates(), then) &&
           ((pose != last && last != 0) || !object.has_grown(stamp.radius));
}

/// Is the object where its prediction says, so that it need not be predicted anew?
///
/// @tparam Scene gives coordinates(id), position(id), has_grown(id, radius) and bounds(id) of an object as they are now.
template <typename Scene> bool prediction_holds(Scene &scene, const ProxyStore &proxies, ProxyId id, Tick now)
{
#ifdef ODE_PREDICTIVE_SPACE_WITHOUT_VERIFY
    // Only for the test which shows that the differential test notices when predictions are trusted blindly.
    return proxies.bounds[id].check != Check::none;
#endif
    if (proxies.bounds[id].check != Check::centre)
        return bounds_hold(scene, proxies, id, now);
    scene.position(id); // has it computed
    const auto *centre = scene.coordinates(id);
    return centre && centre_inside(proxies.paths[id], centre, now) && !scene.has_grown(id, proxies.stamps[id].radius);
}
} // namespace ode_predictive_space

#endif
