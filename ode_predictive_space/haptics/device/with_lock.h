// A lock that is released before an exception propagates.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_WITH_LOCK_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_WITH_LOCK_H

#include <exception>
#include <mutex>

namespace ode_predictive_space::haptics
{
/// An uncaught exception ends the program without unwinding, and a terminate handler that needs the mutex would wait forever.
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
