// Prefetching: asking for memory some time before it is read.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_PREFETCH_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_PREFETCH_H

#include <cstddef>
#include <cstdint>

namespace ode_predictive_space
{
/// The cache line at the address, which may be any, will soon be read or written.
inline void prefetch(const void *address)
{
    __builtin_prefetch(address);
    // GCC takes a function that only prefetches for one without effect and drops its calls; not so with this statement.
    asm volatile("");
}

/// The same for `bytes` bytes from the beginning of a line on.
template <std::size_t bytes> void prefetch_lines(const void *begin)
{
    for (std::size_t offset = 0; offset < bytes; offset += 64)
        prefetch(static_cast<const char *>(begin) + offset);
}

/// The same for `bytes` bytes, wherever in a line they begin.
template <std::size_t bytes> void prefetch_block(const void *begin)
{
    constexpr std::size_t line = 64;
    const auto address = reinterpret_cast<std::uintptr_t>(begin);
    for (std::size_t offset = 0; offset < bytes; offset += line)
        prefetch(reinterpret_cast<const void *>(address + offset)); // NOLINT(performance-no-int-to-ptr)
    prefetch(reinterpret_cast<const void *>(address + bytes - 1));  // NOLINT(performance-no-int-to-ptr)
}

/// Calls visit(i) for i from 0 to count - 1. Before that it calls each of the fetches for the same i: the last one
/// `distance` turns earlier, the last but one twice as many, and so on; in a short loop, each for all before the next. A fetch
/// may read what the fetches before it have asked for.
template <typename Visit, typename... Fetches>
void for_each_prefetched(std::size_t count, std::size_t distance, Visit visit, Fetches... fetches)
{
    const auto call_for_all = [count](auto &call) {
        for (std::size_t i = 0; i < count; ++i)
            call(i);
    };
    if (count <= distance)
    {
        (call_for_all(fetches), ...);
        call_for_all(visit);
        return;
    }
    const std::size_t steps = count + sizeof...(fetches) * distance;
    for (std::size_t step = 0; step < steps; ++step)
    {
        std::size_t i = step; // wraps around below 0, and then is not below count
        ((i < count ? static_cast<void>(fetches(i)) : static_cast<void>(0), i -= distance), ...);
        if (i < count)
            visit(i);
    }
}
} // namespace ode_predictive_space

#endif
