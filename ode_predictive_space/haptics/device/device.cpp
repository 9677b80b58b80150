#include "ode_predictive_space/haptics/device.h"

namespace ode_predictive_space::haptics
{
const char *name_of(DeviceFault fault)
{
    switch (fault)
    {
    case DeviceFault::missing_library:
        return "missing_library";
    case DeviceFault::missing_symbol:
        return "missing_symbol";
    case DeviceFault::missing_file:
        return "missing_file";
    case DeviceFault::bad_file:
        return "bad_file";
    case DeviceFault::permission_denied:
        return "permission_denied";
    case DeviceFault::not_found:
        return "not_found";
    case DeviceFault::not_calibrated:
        return "not_calibrated";
    case DeviceFault::lost:
        return "lost";
    case DeviceFault::failed:
        return "failed";
    case DeviceFault::not_open:
        return "not_open";
    }
    return "unknown";
}
} // namespace ode_predictive_space::haptics
