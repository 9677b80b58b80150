#include "tests/faults/allocation_faults.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace
{
long spared_allocations = -1; // before the one that fails; negative: none fails

void *allocate(std::size_t size, std::size_t alignment)
{
    if (spared_allocations >= 0 && spared_allocations-- == 0)
        throw std::bad_alloc();
    const std::size_t whole = (size + alignment - 1) / alignment * alignment;
    if (void *memory = std::aligned_alloc(alignment, whole == 0 ? alignment : whole))
        return memory;
    throw std::bad_alloc();
}
} // namespace

void *operator new(std::size_t size)
{
    return allocate(size, alignof(std::max_align_t));
}

void *operator new(std::size_t size, std::align_val_t alignment)
{
    return allocate(size, static_cast<std::size_t>(alignment));
}

void *operator new(std::size_t size, const std::nothrow_t &) noexcept
{
    try
    {
        return operator new(size);
    }
    catch (const std::bad_alloc &)
    {
        return nullptr;
    }
}

void operator delete(void *memory, const std::nothrow_t &) noexcept
{
    std::free(memory);
}

void operator delete(void *memory) noexcept
{
    std::free(memory);
}

void operator delete(void *memory, std::size_t) noexcept
{
    std::free(memory);
}

void operator delete(void *memory, std::align_val_t) noexcept
{
    std::free(memory);
}

void operator delete(void *memory, std::size_t, std::align_val_t) noexcept
{
    std::free(memory);
}

namespace ode_predictive_space
{
AllocationFault::AllocationFault(long spared)
{
    spared_allocations = spared;
}

AllocationFault::~AllocationFault()
{
    spared_allocations = -1;
}

bool AllocationFault::struck() const
{
    return spared_allocations < 0;
}
} // namespace ode_predictive_space
