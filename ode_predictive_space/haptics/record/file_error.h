// Errors of files that cannot be opened.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_FILE_ERROR_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_FILE_ERROR_H

#include "ode_predictive_space/haptics/device.h"

#include <cerrno>
#include <system_error>

namespace ode_predictive_space::haptics
{
/// What errno says after a file could not be opened.
inline DeviceError file_error(const std::string &file, int error)
{
    DeviceFault fault = DeviceFault::bad_file;
    if (error == ENOENT || error == ENOTDIR)
        fault = DeviceFault::missing_file;
    else if (error == EACCES || error == EPERM || error == EROFS)
        fault = DeviceFault::permission_denied;
    return DeviceError(fault, "recording " + file + ": " + std::generic_category().message(error));
}
} // namespace ode_predictive_space::haptics

#endif
