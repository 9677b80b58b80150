// A set of proxies that is walked in the order of their numbers, whatever the order they came in.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_ID_SET_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_ID_SET_H

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

    bool empty() const
    {
        for (std::uint64_t word : words_)
            if (word)
                return false;
        return true;
    }

    void clear() { words_.assign(words_.size(), 0); }

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
            members += static_cast<std::size_t>(__builtin_popcountll(word));
        return members;
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
