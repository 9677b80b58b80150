#ifndef ODE_PREDICTIVE_SPACE_RECORDING_CHILD_H
#define ODE_PREDICTIVE_SPACE_RECORDING_CHILD_H

#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>

namespace ode_predictive_space::recording
{
/// Memory that this process and its children share. All zeros at first.
class SharedMemory
{
public:
    /// @throws std::bad_alloc
    explicit SharedMemory(std::size_t size);
    ~SharedMemory();
    SharedMemory(const SharedMemory &) = delete;
    SharedMemory &operator=(const SharedMemory &) = delete;
    void *begin() const { return begin_; }

private:
    void *begin_;
    std::size_t size_;
};

template <typename Value> class SharedArray
{
    static_assert(std::is_trivially_copyable_v<Value>);

public:
    explicit SharedArray(std::size_t count) : memory_(count * sizeof(Value) + 1) {}
    Value &operator[](std::size_t index) const { return static_cast<Value *>(memory_.begin())[index]; }

private:
    SharedMemory memory_;
};

/// Does some work in a process of its own, for ODE's assertions end a process.
///
/// @return why it did not get to its end: ODE's message, or the name of a signal. Empty: it did.
std::string do_in_child(const std::function<void()> &work);
} // namespace ode_predictive_space::recording

#endif
