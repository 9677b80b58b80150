// A set of objects that is iterated in the order of their numbers, not of insertion.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_ID_SET_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_ID_SET_H

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ode_predictive_space/broadphase/base/ids.h"

namespace ode_predictive_space
{
/// One bit per object. Runs stay deterministic although ODE's worker threads report moved geoms in any order.
class IdSet
{
public:
    static constexpr std::uint32_t bits_per_word = 64;

    void resize(std::size_t count)
    {
        const std::size_t words = (count + bits_per_word - 1) / bits_per_word;
        const bool shrinks = words < words_.size();
        words_.resize(words);
        if (!shrinks)
            return;
        words_.shrink_to_fit();
        size_ = 0;
        for_each([this](ProxyId) { ++size_; });
    }

    void insert(ProxyId id)
    {
        std::uint64_t &word = words_[id / bits_per_word];
        size_ += (word & bit(id)) == 0;
        word |= bit(id);
    }

    void erase(ProxyId id)
    {
        std::uint64_t &word = words_[id / bits_per_word];
        size_ -= (word & bit(id)) != 0;
        word &= ~bit(id);
    }

    void clear()
    {
        if (empty())
            return;
        std::fill(words_.begin(), words_.end(), 0);
        size_ = 0;
    }

    bool contains(ProxyId id) const { return (words_[id / bits_per_word] & bit(id)) != 0; }
    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }

    std::size_t words() const { return words_.size(); }
    std::uint64_t word(std::size_t index) const { return words_[index]; }

    template <typename Visit> void for_each(Visit visit) const
    {
        for (std::size_t index = 0; index < words_.size(); ++index)
            visit_word(index, words_[index], visit);
    }

    /// Calls visit(id) for the bits of one word, so that unions and differences of sets can be iterated without building them.
    template <typename Visit> static void visit_word(std::size_t index, std::uint64_t word, Visit &&visit)
    {
        for (; word; word &= word - 1)
            visit(static_cast<ProxyId>(index * bits_per_word) + static_cast<ProxyId>(__builtin_ctzll(word)));
    }

    std::size_t bytes() const { return words_.capacity() * sizeof(std::uint64_t); }

private:
    static std::uint64_t bit(ProxyId id) { return std::uint64_t{1} << (id % bits_per_word); }

    std::vector<std::uint64_t> words_;
    std::size_t size_ = 0;
};
} // namespace ode_predictive_space

#endif
