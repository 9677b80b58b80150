// Locks that are free before an exception leaves.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_WITH_LOCK_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_WITH_LOCK_H

#include <exception>
#include <mutex>

namespace ode_predictive_space::haptics
{
/// Carries out the work under the lock. What it throws is thrown when the mutex is free again: an exception that nothing catches
/// ends the program without unwinding, and a handler that wants the mutex of a guard further up would wait for ever.
template <typename Work> void with_lock(std::mutex &mutex, const Work &work)
{
    std::exception_ptr error;
    {
        const std::lock_guard<std::mutex> lock(mutex);
        try
        {
            work();
        }
        catch (...)
        {
            error = std::current_exception();
        }
    }
    if (error)
        std::rethrow_exception(error);
}
} // namespace ode_predictive_space::haptics

#endif
