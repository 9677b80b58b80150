#include "demos/worlds/pair_list.h"

#include <algorithm>

namespace ode_predictive_space::worlds
{
const NearCallbacks PairList::near = near_callbacks<&PairList::collect>;

void PairList::drop_false_pairs(dSpaceID space)
{
    if (dGeomGetClass(reinterpret_cast<dGeomID>(space)) != dSweepAndPruneSpaceClass)
        return;
    const auto apart = [](const std::pair<dGeomID, dGeomID> &pair) {
        dReal a[6], b[6];
        dGeomGetAABB(pair.first, a);
        dGeomGetAABB(pair.second, b);
        return !(a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3] && a[4] <= b[5] && b[4] <= a[5]);
    };
    pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(), apart), pairs_.end());
}

std::vector<IndexPair> PairList::sorted() const
{
    std::vector<IndexPair> result;
    result.reserve(pairs_.size());
    for (const auto &[geom, other] : pairs_)
    {
        const std::uint32_t first = geom_index(geom);
        const std::uint32_t second = geom_index(other);
        result.emplace_back(std::min(first, second), std::max(first, second));
    }
    std::sort(result.begin(), result.end());
    return result;
}
} // namespace ode_predictive_space::worlds
