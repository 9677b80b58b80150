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
// ThreadSanitizer defines the operators and calls this hook. Calls of malloc() count, too.
extern "C" void __sanitizer_malloc_hook(const volatile void *, std::size_t)
{
    ++allocations;
}
#else
// These replace the standard library's operators, whose other forms call them. If one of a pair were inlined, the compiler
// would see free() applied to memory from new.
[[gnu::noinline]] void *operator new(std::size_t size)
{
    ++allocations;
    if (void *memory = std::malloc(size > 0 ? size : 1))
        return memory;
    throw std::bad_alloc();
}

// Sanitizers define this form themselves, and theirs does not call the one above.
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
