// A set of proxies that is walked in the order of their numbers, whatever the order they came in.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_ID_SET_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_ID_SET_H

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ode_predictive_space/broadphase/types.h"

namespace ode_predictive_space
{
/// A bit per proxy. Inserting costs no order, walking gives one: runs stay deterministic although ODE's worker threads
/// report moved geoms in any order.
class IdSet
{
public:
    /// Makes room for proxies 0 to count - 1; existing members stay.
    void resize(std::size_t count) { words_.resize((count + 63) / 64); }

    void insert(ProxyId id) { words_[id >> 6] |= bit(id); }
    void erase(ProxyId id) { words_[id >> 6] &= ~bit(id); }
    bool contains(ProxyId id) const { return (words_[id >> 6] & bit(id)) != 0; }

    /// Inserts those of the bits of one word; see word().
    void insert_word(std::size_t index, std::uint64_t word) { words_[index] |= word; }

    bool empty() const
    {
        for (std::uint64_t word : words_)
            if (word)
                return false;
        return true;
    }

    void clear() { std::fill(words_.begin(), words_.end(), 0); }

    IdSet &operator|=(const IdSet &other)
    {
        for (std::size_t i = 0; i < words_.size(); ++i)
            words_[i] |= other.words_[i];
        return *this;
    }

    IdSet &operator-=(const IdSet &other)
    {
        for (std::size_t i = 0; i < words_.size(); ++i)
            words_[i] &= ~other.words_[i];
        return *this;
    }

    std::size_t size() const
    {
        std::size_t members = 0;
        for (std::uint64_t word : words_)
            members += count(word);
        return members;
    }

    /// Members in one word. (Without a machine instruction for it, the compiler's own is a call.)
    static std::size_t count(std::uint64_t word)
    {
        word -= (word >> 1) & 0x5555555555555555u;
        word = (word & 0x3333333333333333u) + ((word >> 2) & 0x3333333333333333u);
        return (((word + (word >> 4)) & 0x0f0f0f0f0f0f0f0fu) * 0x0101010101010101u) >> 56;
    }

    std::size_t words() const { return words_.size(); }
    std::uint64_t word(std::size_t index) const { return words_[index]; }

    template <typename Visit> void for_each(Visit visit) const
    {
        for (std::size_t index = 0; index < words_.size(); ++index)
            visit_word(index, words_[index], visit);
    }

    /// Calls visit(id) for the bits of one word; used to walk unions of sets without building them.
    template <typename Visit> static void visit_word(std::size_t index, std::uint64_t word, Visit &&visit)
    {
        for (; word; word &= word - 1)
            visit(static_cast<ProxyId>(index * 64 + static_cast<std::size_t>(__builtin_ctzll(word))));
    }

    std::size_t bytes() const { return words_.capacity() * sizeof(std::uint64_t); }

private:
    static std::uint64_t bit(ProxyId id) { return std::uint64_t{1} << (id & 63); }

    std::vector<std::uint64_t> words_;
};
} // namespace ode_predictive_space

#endif
