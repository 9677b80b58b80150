// Boxes in no order, of which those that overlap another are looked for by looking at all.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BOX_LIST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BOX_LIST_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "ode_predictive_space/broadphase/id_set.h"
#include "ode_predictive_space/broadphase/swept_proxy.h"

namespace ode_predictive_space
{
/// Boxes by proxy. Each side is an array of its own, in fours: four boxes are compared at once.
class BoxList
{
public:
    void reserve(std::size_t boxes)
    {
        proxies_.reserve(boxes);
        blocks_.reserve((boxes + per_block - 1) / per_block);
    }

    /// Adds the box of a proxy, or replaces it.
    void put(const SweptProxy &leaf)
    {
        const std::size_t place = place_of(leaf.proxy);
        if (place == size())
            add(leaf);
        else
            set(place, leaf.box);
    }

    /// Adds the box of a proxy that is not there.
    void add(const SweptProxy &leaf)
    {
        if (size() % per_block == 0)
            blocks_.emplace_back();
        proxies_.push_back(leaf.proxy);
        set(size() - 1, leaf.box);
    }

    /// The proxy must be there.
    void remove(ProxyId proxy)
    {
        const std::size_t place = place_of(proxy), last = size() - 1;
        proxies_[place] = proxies_[last];
        set(place, box(last));
        set(last, nowhere());
        proxies_.pop_back();
        if (last % per_block == 0)
            blocks_.pop_back();
    }

    void clear()
    {
        proxies_.clear();
        blocks_.clear();
    }

    bool empty() const { return proxies_.empty(); }
    std::size_t size() const { return proxies_.size(); }
    SweptProxy operator[](std::size_t place) const { return {proxies_[place], box(place)}; }

    /// Calls visit(proxy) for every proxy whose box overlaps `box`.
    template <typename Visit> void find(const FloatBox &box, Visit visit) const
    {
        const Sides sides(box);
        for (std::size_t first = 0; first < blocks_.size(); first += blocks_per_word)
        {
            const std::size_t count = std::min(blocks_.size() - first, blocks_per_word);
            std::uint64_t found = 0;
            for (std::size_t i = 0; i < count; ++i)
                found |= std::uint64_t{sides.overlapping(blocks_[first + i])} << (per_block * i);
            IdSet::visit_word(first / blocks_per_word, found, [&](std::uint32_t place) { visit(proxies_[place]); });
        }
    }

    /// Calls visit(proxy, other) once for each two proxies whose boxes overlap.
    template <typename Visit> void find_pairs(Visit visit) const
    {
        for (std::size_t place = 0; place + 1 < size(); ++place)
        {
            const Sides sides(box(place));
            std::size_t block = (place + 1) / per_block;
            unsigned behind = ~0u << (place + 1) % per_block;
            for (; block < blocks_.size(); ++block, behind = ~0u)
                for (unsigned found = sides.overlapping(blocks_[block]) & behind; found; found &= found - 1)
                {
                    const auto bit = static_cast<std::size_t>(__builtin_ctz(found));
                    visit(proxies_[place], proxies_[per_block * block + bit]);
                }
        }
    }

    /// Calls visit(proxy) for every proxy whose box a probe of any shape overlaps; see EnvelopeTree::walk().
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        for (std::size_t place = 0; place < size(); ++place)
            if (probe.overlaps(box(place)))
                visit(proxies_[place]);
    }
    template <typename Visit> void walk(const BoxProbe &probe, Visit visit) const { find(probe.box(), visit); }

    std::size_t bytes() const { return proxies_.capacity() * sizeof(ProxyId) + blocks_.capacity() * sizeof(Block); }

private:
    static constexpr std::size_t per_block = 4;
    static constexpr std::size_t blocks_per_word = 64 / per_block;

    /// By axis and box. Those without a box overlap nothing.
    struct alignas(16) Block
    {
        std::array<std::array<float, per_block>, 3> low, high;

        Block()
        {
            for (auto *sides : {&low, &high})
                for (auto &axis : *sides)
                    axis.fill(std::numeric_limits<float>::quiet_NaN());
        }
    };

    /// Those of the box that all others are compared with.
    class Sides
    {
    public:
#if defined(__SSE2__)
        explicit Sides(const FloatBox &box)
        {
            for (std::size_t axis = 0; axis < 3; ++axis)
            {
                low_[axis] = _mm_set1_ps(box.low[axis]);
                high_[axis] = _mm_set1_ps(box.high[axis]);
            }
        }

        /// A bit for each box of the block.
        unsigned overlapping(const Block &block) const
        {
            __m128 overlap = along(block, 0);
            overlap = _mm_and_ps(overlap, along(block, 1));
            overlap = _mm_and_ps(overlap, along(block, 2));
            return static_cast<unsigned>(_mm_movemask_ps(overlap));
        }

    private:
        __m128 along(const Block &block, std::size_t axis) const
        {
            const __m128 ends = _mm_cmple_ps(low_[axis], _mm_load_ps(block.high[axis].data()));
            return _mm_and_ps(ends, _mm_cmpge_ps(high_[axis], _mm_load_ps(block.low[axis].data())));
        }

        __m128 low_[3], high_[3];
#else
        explicit Sides(const FloatBox &box) : box_(box) {}

        unsigned overlapping(const Block &block) const
        {
            unsigned bits = 0;
            for (unsigned i = 0; i < per_block; ++i)
                bits |= static_cast<unsigned>(box_.overlaps(block_box(block, i))) << i;
            return bits;
        }

    private:
        FloatBox box_;
#endif
    };

    static FloatBox block_box(const Block &block, std::size_t i)
    {
        return {{block.low[0][i], block.low[1][i], block.low[2][i]},
                {block.high[0][i], block.high[1][i], block.high[2][i]}};
    }

    static FloatBox nowhere()
    {
        return block_box(Block(), 0);
    }

    std::size_t place_of(ProxyId proxy) const
    {
        return static_cast<std::size_t>(std::find(proxies_.begin(), proxies_.end(), proxy) - proxies_.begin());
    }

    FloatBox box(std::size_t place) const
    {
        return block_box(blocks_[place / per_block], place % per_block);
    }

    void set(std::size_t place, const FloatBox &box)
    {
        Block &block = blocks_[place / per_block];
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            block.low[axis][place % per_block] = box.low[axis];
            block.high[axis][place % per_block] = box.high[axis];
        }
    }

    std::vector<ProxyId> proxies_; // by place
    std::vector<Block> blocks_;    // of so many places each
};
} // namespace ode_predictive_space

#endif
