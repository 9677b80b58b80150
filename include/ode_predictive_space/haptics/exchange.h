// What two threads hand to each other without ever waiting: the latest value, or all values in their order.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_EXCHANGE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_EXCHANGE_H

#include <array>
#include <atomic>
#include <cstddef>
#include <vector>

namespace ode_predictive_space::haptics
{
/// The latest of the values that one thread publishes, for one other thread: a triple buffer.
///
/// Three slots: the writer's draft, the reader's copy, and one in the middle. Publishing and taking swap their own slot with
/// the middle one, so that neither thread ever waits, and neither ever sees half a value. A value that is published before
/// the one in front of it was taken replaces it.
template <typename Value> class Snapshot
{
public:
    /// The writer's alone. Holds an older value until it is written anew.
    Value &draft() { return slots_[draft_]; }

    /// Of the writer: the draft becomes the latest value.
    void publish() { draft_ = middle_.exchange(draft_ | fresh, std::memory_order_acq_rel) & ~fresh; }

    /// Of the reader: latest() becomes the value that was published last.
    ///
    /// @return whether there was a new one.
    bool take()
    {
        if ((middle_.load(std::memory_order_relaxed) & fresh) == 0)
            return false;
        latest_ = middle_.exchange(latest_, std::memory_order_acq_rel) & ~fresh;
        return true;
    }

    /// The reader's alone: what it took last; before that, a value as its constructor made it.
    const Value &latest() const { return slots_[latest_]; }

private:
    static constexpr unsigned fresh = 4; ///< flag beside the number of the middle slot: the reader does not know it yet

    std::array<Value, 3> slots_{};
    unsigned draft_ = 0;
    unsigned latest_ = 1;
    alignas(64) std::atomic<unsigned> middle_{2};
};

/// All values that one thread gives to one other thread, in their order: a ring.
template <typename Value> class Queue
{
public:
    /// @param capacity how many values can be on their way, >= 1.
    explicit Queue(std::size_t capacity) : ring_(capacity + 1) {}

    /// Of the giver: how many more values there is room for, at least.
    std::size_t room() const
    {
        const std::size_t next = next_.load(std::memory_order_relaxed);
        const std::size_t first = first_.load(std::memory_order_acquire);
        return (first + ring_.size() - next - 1) % ring_.size();
    }

    /// Of the giver.
    ///
    /// @return false, and the value is not given, when there is no room.
    bool give(const Value &value)
    {
        if (room() == 0)
            return false;
        const std::size_t next = next_.load(std::memory_order_relaxed);
        ring_[next] = value;
        next_.store((next + 1) % ring_.size(), std::memory_order_release);
        return true;
    }

    /// Of the receiver.
    ///
    /// @return false, and the value is left alone, when there is none.
    bool receive(Value &value)
    {
        const std::size_t first = first_.load(std::memory_order_relaxed);
        if (first == next_.load(std::memory_order_acquire))
            return false;
        value = ring_[first];
        first_.store((first + 1) % ring_.size(), std::memory_order_release);
        return true;
    }

private:
    std::vector<Value> ring_; ///< one slot more than the capacity: full and empty differ
    alignas(64) std::atomic<std::size_t> first_{0};
    alignas(64) std::atomic<std::size_t> next_{0};
};
} // namespace ode_predictive_space::haptics

#endif
