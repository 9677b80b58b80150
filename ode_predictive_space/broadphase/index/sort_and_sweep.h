// All overlapping pairs of many boxes at once: sort and sweep from scratch. In: boxes. Out: pairs.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_SORT_AND_SWEEP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_SORT_AND_SWEEP_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ode_predictive_space/broadphase/index/box_list.h"

namespace ode_predictive_space
{
/// Boxes are sorted along the axis on which they are spread most. Each two neighbours in that order are compared with the boxes
/// that begin before they end, eight at a time, by their places of 16 bits on the other two axes. The few that seem to overlap
/// are compared exactly.
///
/// From some thousands of boxes on, space is first cut into slabs across the axis of the second widest spread, each several
/// boxes wide. A box is in every slab that it reaches into; a pair counts in the slab in which the later of both begins.
/// (Box pruning: Terdiman 2017, parts 15 and 17.)
///
/// Keeps its memory, not its results, from one call to the next.
class SortAndSweep
{
public:
    /// Appends every overlapping pair, each once; the smaller number first.
    ///
    /// @return the number of exact comparisons, a measure of the work.
    std::size_t find_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs);

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

    /// How boxes become keys: the slab in the upper half, the place along the sorted axis in the lower. Keys are less than
    /// 2^31.
    struct Layout
    {
        Scale along, across, other;
        int slab_bits = 0; // a slab is 2^slab_bits places wide

        static Layout fit_for(const Items &items);
        int bits_of_slabs(const Items &items) const;
    };

    /// The places in which a box begins and ends: y is the axis of the slabs, x the sorted one.
    struct Sides
    {
        std::int16_t low_y, high_y, low_z, high_z;
        std::uint32_t low_x, high_x;
    };

    /// The layout for all sides of a box at once. Places do not decrease with the coordinate, whatever the rounding; they are 0
    /// also when it is not a number.
    class Grid
    {
    public:
        explicit Grid(const Layout &layout);
        Sides sides(const FloatBox &box) const;

    private:
        struct Cut
        {
            Float4 begin, scale, last;
            void operator()(const float *four, std::int32_t *places) const;
        };

        int x_, y_, z_;  // axes
        Cut low_, high_; // by coordinate; the high ones from the second lane on
    };

    /// Sides across, of boxes in the order of their keys: one array for each side, with some to spare.
    class Columns
    {
    public:
        void resize(std::size_t count)
        {
            count_ = count;
            places_.resize(4 * count);
        }
        std::int16_t *low_y() { return places_.data(); }
        std::int16_t *high_y() { return low_y() + count_; }
        std::int16_t *low_z() { return high_y() + count_; }
        std::int16_t *high_z() { return low_z() + count_; }
        std::size_t bytes() const { return bytes_of(places_); }

    private:
        std::vector<std::int16_t> places_;
        std::size_t count_ = 0;
    };

    class Rows;

    std::size_t compare_each_with_each(const Items &items, Pairs &pairs);
    std::size_t find_bounded_pairs(const Items &items, Pairs &pairs);
    void sort_into_slabs(const Items &items, const Layout &layout);
    void set_columns(const Sides *sides);
    std::size_t sweep_rows(const Items &items, const Layout &layout, Pairs &pairs);

    static constexpr std::size_t row = 8;     // boxes that are compared at once
    static constexpr std::size_t spare = row; // places behind the last box that may be compared, too

    static constexpr std::uint64_t item_mask = 0xffffffffu;

    BoxList list_;                                   // of few boxes
    Items bounded_, unbounded_;                      // when no slab can hold some of them
    std::vector<std::uint64_t> order_, other_order_; // key, number of the item
    std::vector<std::uint32_t> keys_, ends_;         // of the lowest and the highest coordinate along
    std::vector<Sides> sides_;                       // by item
    Columns columns_;                                // by place in the order
};
} // namespace ode_predictive_space

#endif
