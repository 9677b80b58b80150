#include "ode_predictive_space/haptics/safety/active_run.h"

#include "ode_predictive_space/haptics/safety/open_gates.h"

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
    open_gates::end_all_forces();
    std::fprintf(
        stderr, "ode_predictive_space: %s was destroyed while its loop was running; the program aborts without force\n",
        what);
    std::abort();
}
} // namespace

void ActiveRun::end_and_wait(const char *what) noexcept
{
    stop_.store(true, std::memory_order_relaxed);
    const auto patience = std::this_thread::get_id() == thread_ ? std::chrono::seconds(0) : longest_wait;
    if (ended_.wait_for(patience) == std::future_status::timeout)
        terminate_with(what);
}
} // namespace ode_predictive_space::haptics
