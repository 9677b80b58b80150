#include "ode_predictive_space/haptics/safety/active_run.h"

#include "ode_predictive_space/haptics/safety/program_end.h"

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
    end_all_forces();
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
    if (!ends_soon())
        terminate_with(what);
}

bool ActiveRun::ends_soon() noexcept
{
    std::unique_lock<std::mutex> lock(mutex_);
    const auto patience = std::this_thread::get_id() == thread_ ? std::chrono::seconds(0) : longest_wait;
    return changed_.wait_for(lock, patience, [this] { return ended_; });
}
} // namespace ode_predictive_space::haptics
