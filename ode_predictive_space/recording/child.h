#ifndef ODE_PREDICTIVE_SPACE_RECORDING_CHILD_H
#define ODE_PREDICTIVE_SPACE_RECORDING_CHILD_H

#include <cstddef>
#include <functional>
#include <new>
#include <string>
#include <type_traits>

#include <sys/mman.h>

namespace ode_predictive_space::recording
{
/// Values in memory that this process shares with its children. All zeros at first.
template <typename Value> class SharedArray
{
    static_assert(std::is_trivially_copyable_v<Value>);

public:
    /// @throws std::bad_alloc
    explicit SharedArray(std::size_t count)
        : size_(count * sizeof(Value) + 1),
          begin_(mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
    {
        if (begin_ == MAP_FAILED)
            throw std::bad_alloc();
    }
    ~SharedArray() { munmap(begin_, size_); }
    SharedArray(const SharedArray &) = delete;
    SharedArray &operator=(const SharedArray &) = delete;
    Value &operator[](std::size_t index) const { return static_cast<Value *>(begin_)[index]; }

private:
    std::size_t size_;
    void *begin_;
};

/// Does some work in a child process, because ODE's assertions end a process.
/// @return why the work did not get to its end: ODE's message, or the name of a signal. Empty: it did.
std::string do_in_child(const std::function<void()> &work);
} // namespace ode_predictive_space::recording

#endif
