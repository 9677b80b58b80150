// Boxes in no order: the index of small scenes, and of boxes that no tree can hold.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_BOX_LIST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_BOX_LIST_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "ode_predictive_space/broadphase/base/float_box.h"
#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/base/memory.h"

namespace ode_predictive_space
{
/// Boxes by object. Each side is an array of its own, in fours: a box is compared with four others at once.
class BoxList
{
public:
    /// Adds the box of an object, or replaces it.
    void put(const SweptProxy &leaf)
    {
        const std::size_t place = place_of(leaf.proxy);
        if (place == size())
            add(leaf);
        else
            set(place, leaf.box);
    }

    /// Adds the box of an object that is not in the list.
    void add(const SweptProxy &leaf)
    {
        if (size() % per_block == 0)
            blocks_.emplace_back();
        proxies_.push_back(leaf.proxy);
        set(size() - 1, leaf.box);
    }

    /// Removes an object that is in the list.
    void remove(ProxyId proxy)
    {
        const std::size_t place = place_of(proxy), last = size() - 1;
        proxies_[place] = proxies_[last];
        set(place, box(last));
        set(last, box_of(Block(), 0));
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

    /// Calls visit(proxy) for every object whose box overlaps `box`.
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

    /// Calls visit(proxy, other) once for each two objects whose boxes overlap.
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

    /// Calls visit(proxy) for every object whose box a probe of any shape overlaps; see EnvelopeTree::walk().
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        for (std::size_t place = 0; place < size(); ++place)
            if (probe.overlaps(box(place)))
                visit(proxies_[place]);
    }
    template <typename Visit> void walk(const BoxProbe &probe, Visit visit) const { find(probe.box(), visit); }

    std::size_t bytes() const { return bytes_of(proxies_) + bytes_of(blocks_); }

private:
    static constexpr std::size_t per_block = 4;
    static constexpr std::size_t blocks_per_word = IdSet::bits_per_word / per_block;

    /// Sides by axis and box. Places without a box hold NaN, which overlaps nothing.
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

    /// The sides of one box, four times.
    class Sides
    {
    public:
        explicit Sides(const FloatBox &box)
            : low_{Float4::all(box.low[0]), Float4::all(box.low[1]), Float4::all(box.low[2])},
              high_{Float4::all(box.high[0]), Float4::all(box.high[1]), Float4::all(box.high[2])}
        {}

        /// A bit for each box of the block.
        unsigned overlapping(const Block &block) const
        {
            return (along(block, 0) & along(block, 1) & along(block, 2)).bits();
        }

    private:
        Mask4 along(const Block &block, std::size_t axis) const
        {
            return (low_[axis] <= Float4::load_aligned(block.high[axis].data())) &
                   (high_[axis] >= Float4::load_aligned(block.low[axis].data()));
        }

        Float4 low_[3], high_[3];
    };

    static FloatBox box_of(const Block &block, std::size_t i)
    {
        return {{block.low[0][i], block.low[1][i], block.low[2][i]},
                {block.high[0][i], block.high[1][i], block.high[2][i]}};
    }

    std::size_t place_of(ProxyId proxy) const
    {
        return static_cast<std::size_t>(std::find(proxies_.begin(), proxies_.end(), proxy) - proxies_.begin());
    }

    FloatBox box(std::size_t place) const { return box_of(blocks_[place / per_block], place % per_block); }

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
