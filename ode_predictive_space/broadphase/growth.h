// How arrays grow that have an element for each object, and where they begin.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_GROWTH_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_GROWTH_H

#include <cstddef>
#include <new>
#include <vector>

namespace ode_predictive_space
{
/// Makes room for `count` elements; what is new is a T(). Where that takes new memory it is for a quarter more: doubling, as
/// vectors do by themselves, would leave a third of the memory of a large scene unused.
template <typename T, typename Allocator> void grow(std::vector<T, Allocator> &elements, std::size_t count)
{
    if (count > elements.capacity())
        elements.reserve(count + count / 4);
    elements.resize(count);
}

/// Makes a vector begin with a cache line. What is read together and lies within one there, would otherwise lie in two of them
/// or not by chance, and only the first be fetched.
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
