// Thread access to a predictive space: one thread ticks; several may query at once while their queries only read.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_ACCESS_H
#define ODE_PREDICTIVE_SPACE_SPACE_ACCESS_H

#include <atomic>
#include <mutex>
#include <thread>

namespace ode_predictive_space
{
class Access
{
public:
    /// Permission to tick and call back. It is refused while another thread ticks, and granted to callbacks of the same thread.
    class Turn
    {
    public:
        explicit Turn(Access &access) : holder_(access.ticking_thread_)
        {
            const std::thread::id self = std::this_thread::get_id();
            std::thread::id before;
            taken_ = holder_.compare_exchange_strong(before, self, std::memory_order_acquire);
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

    /// Marks a change of the broad phase by its lifetime. Queries by the aabb function of a user class are refused meanwhile.
    class Work
    {
    public:
        explicit Work(Access &access) : works_(access.works_) { works_.store(true, std::memory_order_relaxed); }
        ~Work() { works_.store(false, std::memory_order_relaxed); }
        Work(const Work &) = delete;
        Work &operator=(const Work &) = delete;

    private:
        std::atomic<bool> &works_;
    };

    bool works() const { return works_.load(std::memory_order_relaxed); }

    /// Nothing was added, moved or set since the last update, so a query only reads. It raises lock_count before it reads this.
    bool is_caught_up() const { return caught_up_.load(std::memory_order_seq_cst); }
    void note_caught_up(bool is_caught_up) { caught_up_.store(is_caught_up, std::memory_order_release); }
    void forget_catching_up() { caught_up_.store(false, std::memory_order_relaxed); }

    /// Held by a query that writes.
    std::recursive_mutex upkeep;

private:
    std::atomic<bool> caught_up_{false};
    std::atomic<bool> works_{false};
    std::atomic<std::thread::id> ticking_thread_{}; // the one in dSpaceCollide(), callbacks included
};
} // namespace ode_predictive_space

#endif
