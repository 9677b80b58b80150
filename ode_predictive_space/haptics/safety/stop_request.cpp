#include "ode_predictive_space/haptics/safety.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <system_error>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::array<int, 4> watched_signals = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
constexpr int nothing = -1;
constexpr int without_signal = 0;

std::atomic<int> request_from{nothing};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not lock");

std::mutex users_mutex; // guards the two below; no handler takes it
int users = 0;
std::array<struct sigaction, watched_signals.size()> old_actions;

extern "C" void note_signal(int number)
{
    request_from.store(number, std::memory_order_relaxed);
}

void restore()
{
    for (std::size_t i = 0; i < watched_signals.size(); ++i)
        sigaction(watched_signals[i], &old_actions[i], nullptr);
}

void install()
{
    struct sigaction action = {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < watched_signals.size(); ++i)
    {
        const bool installed =
            sigaction(watched_signals[i], nullptr, &old_actions[i]) == 0 &&
            (old_actions[i].sa_handler == SIG_IGN || sigaction(watched_signals[i], &action, nullptr) == 0);
        if (!installed)
            throw std::system_error(errno, std::generic_category(), "a signal handler cannot be installed");
    }
}
} // namespace

StopRequest::StopRequest()
{
    const std::lock_guard<std::mutex> lock(users_mutex);
    if (users == 0)
    {
        request_from.store(nothing, std::memory_order_relaxed);
        install();
    }
    ++users;
}

StopRequest::~StopRequest()
{
    const std::lock_guard<std::mutex> lock(users_mutex);
    if (--users == 0)
        restore();
}

bool StopRequest::requested() noexcept
{
    return request_from.load(std::memory_order_relaxed) != nothing;
}

int StopRequest::signal() noexcept
{
    const int number = request_from.load(std::memory_order_relaxed);
    return number == nothing ? 0 : number;
}

void StopRequest::request() noexcept
{
    int expected = nothing;
    request_from.compare_exchange_strong(expected, without_signal, std::memory_order_relaxed);
}
} // namespace ode_predictive_space::haptics
