// What keeps a second tick, and questions, out of a tick that is under way.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_ONE_AT_A_TIME_H
#define ODE_PREDICTIVE_SPACE_SPACE_ONE_AT_A_TIME_H

#include <atomic>
#include <thread>

namespace ode_predictive_space
{
// A thread's turn to tick, callbacks included. Refused while another thread has it; a callback may collide the space again.
class Turn
{
public:
    explicit Turn(std::atomic<std::thread::id> &holder) : holder_(holder)
    {
        const std::thread::id self = std::this_thread::get_id();
        std::thread::id before;
        taken_ = holder.compare_exchange_strong(before, self, std::memory_order_acquire);
        granted_ = taken_ || before == self;
    }
    ~Turn()
    {
        if (taken_)
            holder_.store(std::thread::id(), std::memory_order_release);
    }
    Turn(const Turn &) = delete;
    Turn &operator=(const Turn &) = delete;

    bool granted() const { return granted_; }

private:
    std::atomic<std::thread::id> &holder_;
    bool taken_, granted_;
};

// While it lives the broad phase changes. A callback for bounding boxes that asks the space meanwhile is refused.
class Work
{
public:
    explicit Work(std::atomic<bool> &working) : working_(working) { working.store(true, std::memory_order_relaxed); }
    ~Work() { working_.store(false, std::memory_order_relaxed); }
    Work(const Work &) = delete;
    Work &operator=(const Work &) = delete;

private:
    std::atomic<bool> &working_;
};
} // namespace ode_predictive_space

#endif
