// All overlapping pairs of many boxes at once: sorted and swept.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ode_predictive_space/broadphase/box_list.h"
#include "ode_predictive_space/broadphase/swept_proxy.h"
#include "ode_predictive_space/broadphase/types.h"

namespace ode_predictive_space
{
/// A pair with the smaller number first.
inline CandidatePair in_order(ProxyId one, ProxyId other)
{
    return {std::min(one, other), std::max(one, other)};
}

/// Sort and sweep from scratch: boxes are sorted along the axis on which they are spread most, and each two that are beside
/// each other are compared with those that begin before they end, eight at a time: by where they lie across that axis, in
/// 16 bits. The few that seem to overlap are compared exactly.
///
/// Where there are many, space is first cut into slabs, some times as wide as boxes are, across the axis of the second widest
/// spread. A box is in all the slabs that it reaches into; a pair is found in the slab in which the later of both begins.
///
/// Keeps its memory, not its results, from one call to the next.
class Sweep
{
public:
    /// Makes room for few boxes, which the first tick of a small scene should not spend its time on.
    Sweep() { list_.reserve(few); }

    /// Appends every overlapping pair, each once; the smaller number first.
    void find_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs);

    /// Appends the numbers of all items in the order in which they lie along the axis on which they are spread most.
    void sort_along_widest(const std::vector<SweptProxy> &items, std::vector<ProxyId> &order);

    std::size_t bytes() const;

private:
    using Items = std::vector<SweptProxy>;
    using Pairs = std::vector<CandidatePair>;

    /// An axis cut into places.
    struct Scale
    {
        int axis = 0;
        float begin = 0, places_per_unit = 0;
    };

    /// How boxes become keys: the slab in the upper half, the place along it in the lower. Keys are less than 2^31.
    struct Layout
    {
        Scale along, across, other;
        int slab_bits = 0; // a slab is 2^slab_bits places wide

        static Layout fit_for(const Items &items);
        int bits_of_slabs(const Items &items) const;

        /// Does not decrease with the coordinate, whatever the rounding; 0 also when it is not a number.
        std::uint32_t place_along(float coordinate) const;
    };

    /// In which places a box begins and ends across the axis along which it is sorted (first those of the slabs), and in which
    /// it ends along that.
    struct Sides
    {
        std::int16_t low_y, high_y, low_z, high_z;
        std::uint32_t high_x;
        static Sides of(const FloatBox &box, const Layout &layout);
    };

    /// The sides of boxes in the order of their keys, one array for each, with some to spare.
    struct Columns
    {
        std::vector<std::int16_t> low_y, high_y, low_z, high_z;
        void resize(std::size_t count);
        void set(std::size_t i, const Sides &sides);
    };

    class Rows;

    void compare_each_with_each(const Items &items, Pairs &pairs);
    void find_bounded_pairs(const Items &items, Pairs &pairs);
    void sort_into_slabs(const Items &items, const Layout &layout);
    void sort_keys();
    void sweep_rows(const Items &items, const Layout &layout, Pairs &pairs) const;

    static constexpr std::size_t few = 40;    // up to so many are compared each with each
    static constexpr std::size_t row = 8;     // boxes that are compared at once
    static constexpr std::size_t spare = row; // boxes behind the last that may be compared, too

    static constexpr std::uint64_t item_mask = 0xffffffffu;

    BoxList list_;                                   // of few
    Items bounded_, unbounded_;                      // where there are some that no slab can hold
    std::vector<std::uint64_t> order_, other_order_; // key, number of the item
    std::vector<std::uint32_t> keys_, ends_;         // of the lowest and the highest coordinate along
    std::vector<Sides> sides_;                       // by item
    Columns columns_;                                // by place in the order
};
} // namespace ode_predictive_space

#endif
