// Growth, shrinking and alignment of arrays.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_MEMORY_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_MEMORY_H

#include <cstddef>
#include <new>
#include <vector>

#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
/// Growth reserves a quarter more, as doubling leaves a third of a large array unused. Shrinking gives memory back.
template <typename T, typename Allocator> void resize_array(std::vector<T, Allocator> &elements, std::size_t count)
{
    const bool shrinks = count < elements.size();
    if (count > elements.capacity())
        elements.reserve(count + count / 4);
    elements.resize(count);
    if (shrinks)
        elements.shrink_to_fit();
}

/// Empties an array and gives its memory back. (An assignment of `{}` keeps it.)
template <typename T> void free_memory(std::vector<T> &elements)
{
    elements = std::vector<T>();
}

template <typename T> void give_back_spare(std::vector<T> &elements)
{
    if (elements.capacity() > tuning::kept_elements && elements.size() < elements.capacity() / 8)
        elements.shrink_to_fit();
}

/// Empties an array that the next tick fills again. The memory stays, unless it was grown by a one-off spike.
template <typename T> void clear_scratch(std::vector<T> &scratch)
{
    give_back_spare(scratch);
    scratch.clear();
}

template <typename T, typename Allocator> std::size_t bytes_of(const std::vector<T, Allocator> &elements)
{
    // T may be a pointer: its own size is meant. NOLINTNEXTLINE(bugprone-sizeof-expression)
    return elements.capacity() * sizeof(T);
}

/// Aligns a vector to cache lines, so that no record of line size straddles two lines.
template <typename T> struct CacheLineAllocator
{
    using value_type = T;
    static constexpr std::align_val_t line{64};

    CacheLineAllocator() = default;
    template <typename Other> CacheLineAllocator(const CacheLineAllocator<Other> &) {}

    T *allocate(std::size_t count) { return static_cast<T *>(::operator new(count * sizeof(T), line)); }
    void deallocate(T *elements, std::size_t) { ::operator delete(elements, line); }

    friend bool operator==(const CacheLineAllocator &, const CacheLineAllocator &) { return true; }
    friend bool operator!=(const CacheLineAllocator &, const CacheLineAllocator &) { return false; }
};
} // namespace ode_predictive_space

#endif
