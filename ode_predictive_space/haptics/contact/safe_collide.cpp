#include "ode_predictive_space/haptics/contact/safe_collide.h"
#include "ode_predictive_space/haptics/touch_sensor.h"

#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
thread_local std::exception_ptr last_thrown;

struct Call
{
    dNearCallback *callback;
    void *data;
    std::exception_ptr error;
};

void keep_exception(void *data, dGeomID first, dGeomID second)
{
    Call &call = *static_cast<Call *>(data);
    if (call.error)
        return;
    try
    {
        call.callback(call.data, first, second);
    }
    catch (...)
    {
        call.error = std::current_exception();
    }
}

void throw_kept(const Call &call)
{
    if (call.error)
    {
        last_thrown = call.error;
        std::rethrow_exception(call.error);
    }
}
} // namespace

void safe_collide(dSpaceID space, void *data, dNearCallback *callback)
{
    Call call = {callback, data, nullptr};
    dSpaceCollide(space, &call, &keep_exception);
    throw_kept(call);
}

void safe_collide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback)
{
    Call call = {callback, data, nullptr};
    dSpaceCollide2(first, second, &call, &keep_exception);
    throw_kept(call);
}

bool is_from_safe_collide(const std::exception_ptr &error)
{
    return std::exchange(last_thrown, nullptr) == error;
}
} // namespace ode_predictive_space::haptics
