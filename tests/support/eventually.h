// Waits for another thread, which may take any time on a busy machine: the bound only ends a test that would wait for ever.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_EVENTUALLY_H
#define ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_EVENTUALLY_H

#include <chrono>
#include <thread>

namespace ode_predictive_space
{
/// @return whether the condition became true within two minutes.
template <typename Condition> bool eventually(Condition condition)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!condition())
    {
        if (std::chrono::steady_clock::now() > end)
        {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}
} // namespace ode_predictive_space

#endif
