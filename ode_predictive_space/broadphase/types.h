// Words that all stages of the broad phase share.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_TYPES_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_TYPES_H

#include <cstdint>

#ifdef ODE_PREDICTIVE_SPACE_INSIDE_ODE
#include <ode/precision.h>
#endif

namespace ode_predictive_space
{
/// What the scene computes its positions and bounding boxes in. The broad phase itself computes in double precision, whatever
/// the scene does.
#if defined(ODE_PREDICTIVE_SPACE_INSIDE_ODE) && defined(dSINGLE)
using SceneReal = float;
#else
using SceneReal = double;
#endif

/// Dense number of an object in the broad phase; reused after removal.
using ProxyId = std::uint32_t;
constexpr ProxyId no_proxy = ~ProxyId{0};

/// Time, counted in ticks; it wraps around, so only differences mean something.
using Tick = std::uint32_t;

/// Ticks from `from` to `to`; negative when `to` is earlier.
inline std::int32_t ticks_between(Tick from, Tick to)
{
    return static_cast<std::int32_t>(to - from);
}

/// Which prediction of an object this is. Whatever was derived from an older one is stale.
using Generation = std::uint32_t;

/// Two objects whose envelopes may meet.
struct CandidatePair
{
    ProxyId first;
    ProxyId second;
};
} // namespace ode_predictive_space

#endif
