#include "ode_predictive_space/haptics/active_run.h"

#include "ode_predictive_space/haptics/open_gates.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::chrono::seconds longest_wait(5);

[[noreturn]] void terminate_with(const char *what) noexcept
{
    open_gates::shut_all();
    std::fprintf(stderr, "ode_predictive_space: %s was destroyed while its loop was running\n", what);
    std::abort();
}
} // namespace

void ActiveRun::end() noexcept
{
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
    changed_.notify_all();
}

void ActiveRun::end_and_wait(const char *what) noexcept
{
    stop_.store(true, std::memory_order_relaxed);
    std::unique_lock<std::mutex> lock(mutex_);
    if (ended_)
    {
        return;
    }
    if (std::this_thread::get_id() == thread_ || !changed_.wait_for(lock, longest_wait, [this] { return ended_; }))
    {
        terminate_with(what);
    }
}
} // namespace ode_predictive_space::haptics
