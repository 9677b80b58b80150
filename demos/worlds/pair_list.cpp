#include "demos/worlds/pair_list.h"

#include "ode_predictive_space/haptics/device/random.h"

#include <algorithm>

namespace ode_predictive_space::worlds
{
namespace
{
bool boxes_overlap(dGeomID first, dGeomID second)
{
    dReal a[6];
    dReal b[6];
    dGeomGetAABB(first, a);
    dGeomGetAABB(second, b);
    return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3] && a[4] <= b[5] && b[4] <= a[5];
}
} // namespace

void set_geom_index(dGeomID geom, std::uint32_t index)
{
    dGeomSetData(geom, reinterpret_cast<void *>(static_cast<std::uintptr_t>(index)));
}

std::uint32_t geom_index(dGeomID geom)
{
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(dGeomGetData(geom)));
}

const NearCallbacks PairList::near = near_callbacks<&PairList::collect>;

std::size_t PairList::drop_pairs_apart()
{
    const auto apart = [](const std::pair<dGeomID, dGeomID> &pair) { return !boxes_overlap(pair.first, pair.second); };
    const auto end = std::remove_if(pairs_.begin(), pairs_.end(), apart);
    const auto dropped = static_cast<std::size_t>(pairs_.end() - end);
    pairs_.erase(end, pairs_.end());
    return dropped;
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

// A sum, not an exclusive or: a pair that is reported twice must not cancel itself.
std::uint64_t hash_pairs(const std::vector<IndexPair> &pairs)
{
    std::uint64_t sum = 0;
    for (const auto &[first, second] : pairs)
        sum += haptics::mix_bits((std::uint64_t{first} << 32 | second) + 0x9e3779b97f4a7c15u);
    return sum;
}

void PairHash::add_tick(std::uint64_t hash_of_pairs)
{
    value_ = haptics::mix_bits(value_ + 0x9e3779b97f4a7c15u) ^ hash_of_pairs;
}
} // namespace ode_predictive_space::worlds
