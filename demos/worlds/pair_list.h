// The pairs that a space reports, in a form in which spaces can be compared.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_PAIR_LIST_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_PAIR_LIST_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <ode/ode.h>
#include <utility>
#include <vector>

namespace ode_predictive_space::worlds
{
struct SpaceDestroyer
{
    void operator()(dSpaceID space) const { dSpaceDestroy(space); }
};

using OwnedSpace = std::unique_ptr<dxSpace, SpaceDestroyer>;

/// Give a geom its number in the world. It is kept in the geom's data pointer.
inline void set_geom_index(dGeomID geom, std::uint32_t index)
{
    dGeomSetData(geom, reinterpret_cast<void *>(static_cast<std::uintptr_t>(index)));
}

inline std::uint32_t geom_index(dGeomID geom)
{
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(dGeomGetData(geom)));
}

using IndexPair = std::pair<std::uint32_t, std::uint32_t>; ///< numbers of two geoms, the smaller first

struct NearCallbacks
{
    dNearCallback *geoms;
    dNearCallback *nested; ///< when one of the two may be a space: calls back for the pairs of its geoms
};

template <dNearCallback *callback> void near_nested(void *data, dGeomID first, dGeomID second)
{
    if (dGeomIsSpace(first) != 0 || dGeomIsSpace(second) != 0)
    {
        dSpaceCollide2(first, second, data, &near_nested<callback>);
        return;
    }
    callback(data, first, second);
}

template <dNearCallback *callback> constexpr NearCallbacks near_callbacks{callback, &near_nested<callback>};

/// Collects the pairs of one dSpaceCollide(). The callback is within the measured time, so it does as little as possible.
class PairList
{
public:
    PairList() { pairs_.reserve(4096); }

    /// The near callback; `list` is a PairList.
    static void collect(void *list, dGeomID first, dGeomID second)
    {
        static_cast<PairList *>(list)->pairs_.emplace_back(first, second);
    }

    static const NearCallbacks near;

    void clear() { pairs_.clear(); }
    std::size_t size() const { return pairs_.size(); }

    /// The pairs in the order of their callbacks.
    const std::vector<std::pair<dGeomID, dGeomID>> &geoms() const { return pairs_; }

    /// ODE's sweep-and-prune space rounds its first axis to single precision: it reports pairs with a gap in the eighth digit.
    /// Drops them if the pairs are that space's. Only right after dSpaceCollide(), because the present boxes are used.
    void drop_false_pairs(dSpaceID space);

    /// In ascending order of the geoms' numbers: the same list for every space. Valid while the geoms live.
    std::vector<IndexPair> sorted() const;

private:
    std::vector<std::pair<dGeomID, dGeomID>> pairs_;
};
} // namespace ode_predictive_space::worlds

#endif
