// Prefetching of memory.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_PREFETCH_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_BASE_PREFETCH_H

#include <cstddef>
#include <cstdint>

namespace ode_predictive_space
{
/// Fetches the cache line at an address, which may be invalid.
inline void prefetch(const void *address)
{
    __builtin_prefetch(address);
    // Without this statement GCC drops calls of a function that only prefetches.
    asm volatile("");
}

template <std::size_t bytes> void prefetch_block(const void *begin)
{
    constexpr std::size_t line = 64;
    const auto address = reinterpret_cast<std::uintptr_t>(begin);
    for (std::size_t offset = 0; offset < bytes; offset += line)
        prefetch(reinterpret_cast<const void *>(address + offset)); // NOLINT(performance-no-int-to-ptr)
    prefetch(reinterpret_cast<const void *>(address + bytes - 1));  // NOLINT(performance-no-int-to-ptr)
}

/// Calls visit(i) for i from 0 to count - 1, and each fetch with the same i before: the last fetch `distance` iterations
/// earlier, the last but one twice as many, and so on; in a short loop, all calls of a fetch precede the next fetch. So a fetch
/// may read memory that the fetches before it have fetched.
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
        std::size_t i = step; // wraps around below 0 to more than count
        ((i < count ? static_cast<void>(fetches(i)) : static_cast<void>(0), i -= distance), ...);
        if (i < count)
            visit(i);
    }
}
} // namespace ode_predictive_space

#endif
