// All overlapping pairs of many boxes at once: strips, sorted and swept.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

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
/// each other are compared, four at a time, with those that begin before they end.
///
/// Where there are many, space is first cut into strips as wide as most boxes are, across the axis of the second widest
/// spread. A box belongs to the strip in which it begins, so that it can meet only what begins there or in a strip beside
/// it. Boxes wider than a strip look up those that they can meet, and are then swept among themselves in the same way.
///
/// Keeps its memory, not its results, from one call to the next.
class Sweep
{
public:
    /// Appends every overlapping pair, each once; the smaller number first.
    void find_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs);

    /// Appends the numbers of all items in the order in which they lie along the axis on which they are spread most.
    void sort_along_widest(const std::vector<SweptProxy> &items, std::vector<ProxyId> &order);

    std::size_t bytes() const;

private:
    /// How boxes become keys: the strip in the upper half, the place along it in the lower. Keys are less than 2^31.
    struct Layout
    {
        int along = 0, across = 1, other = 2; // axes
        float begin = 0, scale = 0;           // along
        float first = 0, strips_per_unit = 0; // across
        float widest = 0;                     // of what belongs to a single strip

        static Layout fit_for(const std::vector<SweptProxy> &items);
        void cut_into_strips(const std::vector<SweptProxy> &items);
        std::uint32_t place(float coordinate) const;
        std::uint32_t strip(float coordinate) const;
        bool fits(const FloatBox &box) const { return box.high[across] - box.low[across] <= widest; }
        std::uint32_t key(std::uint32_t strip, float coordinate) const { return strip << 16 | place(coordinate); }
    };

    /// What a box is compared with the others by.
    struct Probe
    {
        ProxyId proxy;
        std::array<float, 3> low, high; // along, across, other
    };

    /// Boxes in the order of their keys, one array for each side, with some to spare that no comparison meets.
    struct Sides
    {
        std::array<std::vector<float>, 3> low, high; // along, across, other
        void resize(std::size_t count);
    };

    struct Columns;
    struct Four;
    class FourfoldProbe;
    class TwoProbes;
    class RowsBeside;

    void find_bounded_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs);
    void sort_into_strips(const std::vector<SweptProxy> &items, const Layout &layout);
    void sort_keys();
    void sweep_strips(std::vector<CandidatePair> &pairs) const;
    void sweep_single_strip(std::vector<CandidatePair> &pairs) const;
    Probe probe(std::size_t i) const;
    void look_up(const SweptProxy &item, const Layout &layout, std::vector<CandidatePair> &pairs) const;
    void compare_from(std::size_t begin, std::uint32_t end, const Probe &probe,
                      std::vector<CandidatePair> &pairs) const;

    static constexpr std::size_t spare = 4;

    std::vector<SweptProxy> wider_, still_wider_;    // than the strips of this level and the next
    std::vector<SweptProxy> bounded_, unbounded_;    // where there are some that no strip can hold
    std::vector<std::uint64_t> order_, other_order_; // key, number of the item
    std::vector<std::uint32_t> keys_, ends_;         // of the lowest and the highest coordinate along
    std::vector<ProxyId> proxies_;
    Sides sides_;
    float longest_ = 0; // along, of the boxes in strips
};
} // namespace ode_predictive_space

#endif
