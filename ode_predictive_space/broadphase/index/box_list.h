// An unordered list of boxes: the index of small scenes, and of boxes that no tree can hold.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_BOX_LIST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_INDEX_BOX_LIST_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ode_predictive_space/broadphase/base/four_boxes.h"
#include "ode_predictive_space/broadphase/base/id_set.h"
#include "ode_predictive_space/broadphase/base/memory.h"

namespace ode_predictive_space
{
class BoxList
{
public:
    void put(const SweptProxy &leaf)
    {
        const std::size_t place = place_of(leaf.proxy);
        if (place == size())
            add(leaf);
        else
            set(place, leaf.box);
    }

    /// @pre the object is not in the list.
    void add(const SweptProxy &leaf)
    {
        if (size() % per_block == 0)
            blocks_.emplace_back();
        proxies_.push_back(leaf.proxy);
        set(size() - 1, leaf.box);
    }

    /// @pre the object is in the list.
    void remove(ProxyId proxy)
    {
        const std::size_t place = place_of(proxy), last = size() - 1;
        proxies_[place] = proxies_[last];
        set(place, box(last));
        blocks_[last / per_block].clear(last % per_block);
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

    /// Calls visit(proxy) for each object whose box the probe overlaps; see EnvelopeTree::walk().
    template <typename Probe, typename Visit> void walk(const Probe &probe, Visit visit) const
    {
        for (std::size_t first = 0; first < blocks_.size(); first += blocks_per_word)
        {
            const std::size_t count = std::min(blocks_.size() - first, blocks_per_word);
            std::uint64_t found = 0;
            for (std::size_t i = 0; i < count; ++i)
                found |= std::uint64_t{probe.overlaps(blocks_[first + i])} << (per_block * i);
            if (const std::size_t left = size() - per_block * first; left < IdSet::bits_per_word)
                found &= ~(~std::uint64_t{0} << left);
            IdSet::visit_word(first / blocks_per_word, found, [&](std::uint32_t place) { visit(proxies_[place]); });
        }
    }

    template <typename Visit> void find_pairs(Visit visit) const
    {
        for (std::size_t place = 0; place + 1 < size(); ++place)
        {
            const BoxProbe probe(box(place));
            std::size_t first = (place + 1) / per_block * per_block;
            unsigned behind = ~0u << (place + 1) % per_block;
            for (; first < size(); first += per_block, behind = ~0u)
            {
                const std::size_t left = std::min(size() - first, per_block);
                for (unsigned found = probe.overlaps(blocks_[first / per_block]) & behind & ~(~0u << left); found;
                     found &= found - 1)
                    visit(proxies_[place], proxies_[first + static_cast<std::size_t>(__builtin_ctz(found))]);
            }
        }
    }

    std::size_t bytes() const { return bytes_of(proxies_) + bytes_of(blocks_); }

private:
    static constexpr std::size_t per_block = FourBoxes::most;
    static constexpr std::size_t blocks_per_word = IdSet::bits_per_word / per_block;

    std::size_t place_of(ProxyId proxy) const
    {
        return static_cast<std::size_t>(std::find(proxies_.begin(), proxies_.end(), proxy) - proxies_.begin());
    }

    FloatBox box(std::size_t place) const { return blocks_[place / per_block][place % per_block]; }
    void set(std::size_t place, const FloatBox &box) { blocks_[place / per_block].set(place % per_block, box); }

    std::vector<ProxyId> proxies_; // by place
    std::vector<FourBoxes> blocks_;
};
} // namespace ode_predictive_space

#endif
