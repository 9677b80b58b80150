// All overlapping pairs of a set of boxes, from scratch: what the space does when prediction does not pay.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ode_predictive_space/broadphase/swept_proxy.h"
#include "ode_predictive_space/broadphase/types.h"

namespace ode_predictive_space
{
/// Sort and sweep: sorts the boxes along the axis on which they are spread most, and compares each with those that begin
/// before it ends, both other axes in one vector comparison.
class Sweep
{
public:
    /// Appends every overlapping pair, each once; the smaller number first.
    void find_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs);

    std::size_t bytes() const;

private:
    /// The two other axes of a box as (low, low, -high, -high): two boxes overlap there exactly when each component of one
    /// is <= the negated, swapped component of the other.
    struct alignas(16) Slab
    {
        float component[4];
    };

    void sort_along(const std::vector<SweptProxy> &items, int axis);

    std::vector<std::uint64_t> keys_;
    std::vector<std::uint64_t> other_keys_;
    std::vector<float> low_;
    std::vector<float> high_;
    std::vector<Slab> slabs_;
    std::vector<ProxyId> proxies_;
};
} // namespace ode_predictive_space

#endif
