// A loop that runs, for what must not go before it ends.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_ACTIVE_RUN_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_ACTIVE_RUN_H

#include <atomic>
#include <future>
#include <thread>

namespace ode_predictive_space::haptics
{
/// Shared by a loop and its probe, and outlives both. Made in the thread that calls run().
class ActiveRun
{
public:
    /// Whether the loop is to end. From any thread.
    bool is_told_to_stop() const { return stop_.load(std::memory_order_relaxed); }

    /// Of the loop: it has ended, and touches neither itself nor the probe any more.
    void end() { end_.set_value(); }

    /// Of a destructor: tell the loop to end, and wait for it. In the loop's own thread, or when it does not end within 5 s, the
    /// program is terminated: without force, and with a message.
    ///
    /// @param what is destroyed.
    void end_and_wait(const char *what) noexcept;

private:
    const std::thread::id thread_ = std::this_thread::get_id();
    std::atomic<bool> stop_{false};
    std::promise<void> end_;
    const std::shared_future<void> ended_ = end_.get_future().share();
};
} // namespace ode_predictive_space::haptics

#endif
