// Types that all stages of the broad phase share: objects, ticks, pairs.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_IDS_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_IDS_H

#include <algorithm>
#include <cstdint>

namespace ode_predictive_space
{
/// A dense number, reused after removal.
using ProxyId = std::uint32_t;

/// Time in ticks. It wraps around, so only differences are meaningful.
using Tick = std::uint32_t;

/// Negative when `to` is earlier than `from`.
inline std::int32_t ticks_between(Tick from, Tick to)
{
    return static_cast<std::int32_t>(to - from);
}

struct CandidatePair
{
    ProxyId first;
    ProxyId second;
};

inline CandidatePair in_order(ProxyId one, ProxyId other)
{
    return {std::min(one, other), std::max(one, other)};
}
} // namespace ode_predictive_space

#endif
