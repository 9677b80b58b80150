// A running loop, for objects that must outlive its run.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_ACTIVE_RUN_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_ACTIVE_RUN_H

#include <atomic>
#include <future>
#include <thread>

namespace ode_predictive_space::haptics
{
/// Shared by a loop and its probe; made in the thread that calls run().
class ActiveRun
{
public:
    bool stop_requested() const { return stop_.load(std::memory_order_relaxed); }

    /// For the loop: it has ended, and uses neither itself nor the probe any more.
    void end() { end_.set_value(); }

    /// For destructors: ends the loop, and waits for it. In the loop's own thread, or after 5 s, terminates the program without
    /// force and with a message.
    void end_and_wait(const char *what) noexcept;

private:
    const std::thread::id thread_ = std::this_thread::get_id();
    std::atomic<bool> stop_{false};
    std::promise<void> end_;
    const std::shared_future<void> ended_ = end_.get_future().share();
};
} // namespace ode_predictive_space::haptics

#endif
