#include "tests/haptics/support/allocation_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define ODE_PREDICTIVE_SPACE_OPERATORS_ARE_TAKEN
#endif
#endif

namespace
{
std::atomic<std::uint64_t> allocations{0};
}

#ifdef ODE_PREDICTIVE_SPACE_OPERATORS_ARE_TAKEN
// By ThreadSanitizer, which calls this. Calls of malloc() count, too.
extern "C" void __sanitizer_malloc_hook(const volatile void *, std::size_t)
{
    ++allocations;
}
#else
// In place of the standard library's; its other forms of new and delete call these. Inlined, one of a pair but not the other, they
// look to the compiler as if new were freed.
[[gnu::noinline]] void *operator new(std::size_t size)
{
    ++allocations;
    if (void *memory = std::malloc(size > 0 ? size : 1))
        return memory;
    throw std::bad_alloc();
}

// Sanitizers have one of their own, which does not call the one above.
[[gnu::noinline]] void *operator new(std::size_t size, const std::nothrow_t &) noexcept
{
    ++allocations;
    return std::malloc(size > 0 ? size : 1);
}

[[gnu::noinline]] void operator delete(void *memory) noexcept
{
    std::free(memory);
}

[[gnu::noinline]] void operator delete(void *memory, std::size_t) noexcept
{
    std::free(memory);
}
#endif

namespace ode_predictive_space::haptics
{
std::uint64_t allocation_count()
{
    return allocations;
}
} // namespace ode_predictive_space::haptics
