// Sort and sweep from scratch. In: many boxes. Out: all overlapping pairs.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_SORT_AND_SWEEP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_SORT_AND_SWEEP_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ode_predictive_space/broadphase/index/box_list.h"

namespace ode_predictive_space
{
/// Boxes are sorted along the axis of their widest spread. Each two neighbours in that order are compared with the boxes that
/// begin before they end, eight at a time, by 16-bit grid positions on the other axes; candidates are compared exactly. Many
/// boxes are first divided into slabs along the axis of the second widest spread. A box is in each slab that it reaches; a pair
/// is reported in the slab in which the later box begins. (Box pruning: Terdiman 2017, parts 15, 17.)
class SortAndSweep
{
public:
    /// Appends each overlapping pair once, the smaller number first.
    /// @return the number of exact comparisons, a measure of the work.
    std::size_t find_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs);

    std::size_t bytes() const;

private:
    using Items = std::vector<SweptProxy>;
    using Pairs = std::vector<CandidatePair>;

    struct Scale
    {
        int axis = 0;
        float begin = 0, places_per_unit = 0;
    };

    /// The grid for keys: the slab in the upper half, the place along the sorted axis in the lower. Keys are below 2^31.
    struct Layout
    {
        Scale along, across, other;
        int slab_bits = 0; // a slab is 2^slab_bits places wide

        static Layout fit_for(const Items &items);
        int bits_of_slabs(const Items &items) const;
    };

    /// The places in which a box begins and ends. x is the sorted axis, y that of the slabs.
    struct Sides
    {
        std::int16_t low_y, high_y, low_z, high_z;
        std::uint32_t low_x, high_x;
    };

    /// Computes all sides of a box at once. Places never decrease with the coordinate, whatever the rounding; NaN becomes 0.
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
        Cut low_, high_; // lanes by coordinate; high_ begins in the second lane
    };

    class Rows;

    std::size_t compare_each_with_each(const Items &items, Pairs &pairs);
    std::size_t find_bounded_pairs(const Items &items, Pairs &pairs);
    void sort_into_slabs(const Items &items, const Layout &layout);
    void set_columns(const Sides *sides);
    std::size_t sweep_rows(const Items &items, const Layout &layout, Pairs &pairs);

    static constexpr std::size_t row = 8;     // boxes that are compared at once
    static constexpr std::size_t spare = row; // elements after the last box that a row may read

    static constexpr std::uint64_t item_mask = 0xffffffffu;

    // All is scratch, kept for its memory.
    BoxList list_;                                   // few or unbounded boxes
    Items bounded_, unbounded_;                      // the items, if some are unbounded
    std::vector<std::uint64_t> order_, other_order_; // key in the upper half, number of the item in the lower
    std::vector<std::uint32_t> keys_, ends_;         // low and high key of each element of order_
    std::vector<Sides> sides_;                       // by item
    std::vector<std::int16_t> low_y_, high_y_, low_z_, high_z_; // in the order of order_
};
} // namespace ode_predictive_space

#endif
