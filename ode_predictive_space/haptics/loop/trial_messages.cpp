#include "ode_predictive_space/haptics/loop/trial_messages.h"

#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <ode/error.h>

namespace ode_predictive_space::haptics
{
namespace
{
thread_local bool tries = false;
thread_local std::uint64_t kept_back = 0;

std::mutex handler_mutex; // guards trials and the exchange of handlers
int trials = 0;
std::atomic<dMessageFunction *> handler_of_program{nullptr};

void take_message(int number, const char *text, va_list arguments)
{
    if (tries)
    {
        ++kept_back;
        return;
    }
    if (dMessageFunction *const handler = handler_of_program)
        return handler(number, text, arguments);
    std::fprintf(stderr, "\nODE Message %d: ", number); // as ODE does without a handler
    std::vfprintf(stderr, text, arguments);
    std::fprintf(stderr, "\n");
}
} // namespace

TrialMessages::TrialMessages()
{
    const std::lock_guard<std::mutex> lock(handler_mutex);
    if (trials++ == 0)
    {
        handler_of_program = dGetMessageHandler();
        dSetMessageHandler(&take_message);
    }
    kept_back = 0;
    tries = true;
}

TrialMessages::~TrialMessages()
{
    tries = false;
    const std::lock_guard<std::mutex> lock(handler_mutex);
    if (--trials == 0)
        dSetMessageHandler(handler_of_program);
}

std::uint64_t TrialMessages::count() const
{
    return kept_back;
}
} // namespace ode_predictive_space::haptics
