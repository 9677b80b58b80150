// Asking for memory some time before it is read.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_PREFETCH_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_PREFETCH_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ode_predictive_space
{
/// What is read of so few objects stays in a cache nearby from one tick to the next.
constexpr std::size_t cached_objects = 300;

/// The same of what is kept of them to compare their boxes, which is much less.
constexpr std::size_t cached_boxes = 2000;

/// The same of what was read to measure their boxes, later in the same tick.
constexpr std::size_t cached_measured = 2000;

/// The cache line at the address, which may be any, will soon be read or written.
inline void prefetch(const void *address)
{
    __builtin_prefetch(address);
    // GCC takes a function that only prefetches for one that does nothing, and drops the calls of it. Not of one with this.
    asm volatile("");
}

/// The same for so many bytes, wherever in a line they begin.
template <std::size_t bytes> void prefetch_block(const void *begin)
{
    constexpr std::size_t line = 64;
    const auto address = reinterpret_cast<std::uintptr_t>(begin);
    for (std::size_t offset = 0; offset < bytes; offset += line)
        prefetch(reinterpret_cast<const void *>(address + offset)); // NOLINT(performance-no-int-to-ptr)
    prefetch(reinterpret_cast<const void *>(address + bytes - 1));  // NOLINT(performance-no-int-to-ptr)
}

/// The element that comes some time after the i-th, far enough to be fetched meanwhile; the last one when there is none.
template <typename T> const T &later(const T *elements, std::size_t count, std::size_t i, std::size_t distance = 8)
{
    return elements[std::min(i + distance, count - 1)];
}

template <typename T> const T &later(const std::vector<T> &elements, std::size_t i, std::size_t distance = 8)
{
    return later(elements.data(), elements.size(), i, distance);
}
} // namespace ode_predictive_space

#endif
