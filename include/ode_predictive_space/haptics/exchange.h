// Wait-free exchange between two threads: the latest value, or all values in their order.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_EXCHANGE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_EXCHANGE_H

#include <array>
#include <atomic>
#include <cstddef>
#include <vector>

namespace ode_predictive_space::haptics
{
/// Triple buffer: the latest of the values that one thread publishes, for one other thread.
///
/// There are three slots: the writer's draft, the reader's copy, and one between them. Publishing swaps the draft with the
/// middle slot, and taking swaps the copy with it, so no thread waits or sees a partial value. A new value replaces one that was not
/// taken.
template <typename Value> class Snapshot
{
public:
    /// For the writer: the next value; it holds an older one until it is overwritten.
    Value &draft() { return slots_[draft_]; }

    /// For the writer: the draft becomes the latest value.
    void publish() { draft_ = middle_.exchange(draft_ | fresh, std::memory_order_acq_rel) & ~fresh; }

    /// For the reader: latest() becomes the last published value.
    ///
    /// @return whether it is a new one.
    bool take()
    {
        if ((middle_.load(std::memory_order_relaxed) & fresh) == 0)
            return false;
        latest_ = middle_.exchange(latest_, std::memory_order_acq_rel) & ~fresh;
        return true;
    }

    /// For the reader: the value of the last take(); before that, a default-constructed one.
    const Value &latest() const { return slots_[latest_]; }

private:
    static constexpr unsigned fresh = 4; ///< flag of a middle slot that the reader has not taken

    std::array<Value, 3> slots_{};
    unsigned draft_ = 0;
    unsigned latest_ = 1;
    alignas(64) std::atomic<unsigned> middle_{2};
};

/// Ring buffer: all values that one thread gives to one other thread, in their order.
template <typename Value> class Queue
{
public:
    /// @param capacity maximum number of queued values, >= 1. Allocates.
    explicit Queue(std::size_t capacity) : ring_(capacity + 1) {}

    /// For the giver: the minimum number of free places.
    std::size_t room() const
    {
        const std::size_t next = next_.load(std::memory_order_relaxed);
        const std::size_t first = first_.load(std::memory_order_acquire);
        return (first + ring_.size() - next - 1) % ring_.size();
    }

    /// For the giver: appends a value.
    ///
    /// @return false, without an effect, when the queue is full.
    bool give(const Value &value)
    {
        if (room() == 0)
            return false;
        const std::size_t next = next_.load(std::memory_order_relaxed);
        ring_[next] = value;
        next_.store((next + 1) % ring_.size(), std::memory_order_release);
        return true;
    }

    /// For the receiver: removes the first value.
    ///
    /// @return false, with the value unchanged, when the queue is empty.
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
    std::vector<Value> ring_; ///< capacity + 1 slots, to distinguish full from empty
    alignas(64) std::atomic<std::size_t> first_{0};
    alignas(64) std::atomic<std::size_t> next_{0};
};
} // namespace ode_predictive_space::haptics

#endif
