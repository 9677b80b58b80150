#include "ode_predictive_space/haptics/device.h"

namespace ode_predictive_space::haptics
{
const char *name_of(DeviceFault fault)
{
    static constexpr const char *names[] = {
        "missing_library", "missing_symbol", "missing_file", "bad_file", "permission_denied",
        "not_found",       "not_calibrated", "lost",         "failed",   "not_open"};
    return names[static_cast<int>(fault)];
}
} // namespace ode_predictive_space::haptics
