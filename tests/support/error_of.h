#ifndef ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_ERROR_OF_H
#define ODE_PREDICTIVE_SPACE_TESTS_SUPPORT_ERROR_OF_H

#include <stdexcept>

namespace ode_predictive_space
{
/// The exception of a call that has to throw one.
template <typename Error, typename Call> Error error_of(Call call)
{
    try
    {
        call();
    }
    catch (const Error &error)
    {
        return error;
    }
    throw std::logic_error("nothing was thrown");
}
} // namespace ode_predictive_space

#endif
