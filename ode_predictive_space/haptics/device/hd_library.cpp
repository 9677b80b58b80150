#include "ode_predictive_space/haptics/device/hd_library.h"

#include <cstdio>
#include <cstring>
#include <dlfcn.h>

namespace ode_predictive_space::haptics
{
namespace
{
/// Of errors taken at once. An error that comes up again while it is taken must not keep the servo thread.
constexpr int most_errors_at_once = 32;

/// @throws DeviceError missing_library.
void *load_first_of(const std::vector<std::string> &files)
{
    std::string reasons;
    for (const std::string &file : files)
    {
        // Never unloaded: see the class. All symbols at once, so that what is missing shows here and not in the servo
        // thread.
        if (void *handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE))
            return handle;
        reasons += std::string(reasons.empty() ? "" : "; ") + dlerror();
    }
    throw DeviceError(DeviceFault::missing_library, "OpenHaptics: the library cannot be loaded: " + reasons);
}

/// Where a loaded symbol really is: the file may have been found on a search path, or under a second name.
std::string file_of(void *symbol)
{
    Dl_info info{};
    return symbol != nullptr && dladdr(symbol, &info) != 0 ? info.dli_fname : "the library";
}

template <typename Function> void find(void *handle, const char *name, Function *&function)
{
    void *symbol = dlsym(handle, name);
    if (symbol == nullptr)
    {
        throw DeviceError(DeviceFault::missing_symbol,
                          "OpenHaptics: " + file_of(dlsym(handle, "hdInitDevice")) + " has no function " + name);
    }
    // The way POSIX gives for an object pointer that is a function's.
    std::memcpy(&function, &symbol, sizeof symbol);
}

hd::Functions functions_in(void *handle)
{
    hd::Functions functions{};
    find(handle, "hdInitDevice", functions.init_device);
    find(handle, "hdDisableDevice", functions.disable_device);
    find(handle, "hdMakeCurrentDevice", functions.make_current_device);
    find(handle, "hdBeginFrame", functions.begin_frame);
    find(handle, "hdEndFrame", functions.end_frame);
    find(handle, "hdGetError", functions.get_error);
    find(handle, "hdGetErrorString", functions.get_error_string);
    find(handle, "hdGetString", functions.get_string);
    find(handle, "hdEnable", functions.enable);
    find(handle, "hdDisable", functions.disable);
    find(handle, "hdGetDoublev", functions.get_doublev);
    find(handle, "hdGetIntegerv", functions.get_integerv);
    find(handle, "hdSetDoublev", functions.set_doublev);
    find(handle, "hdStartScheduler", functions.start_scheduler);
    find(handle, "hdStopScheduler", functions.stop_scheduler);
    find(handle, "hdScheduleAsynchronous", functions.schedule_asynchronous);
    find(handle, "hdUnschedule", functions.unschedule);
    find(handle, "hdCheckCalibration", functions.check_calibration);
    find(handle, "hdUpdateCalibration", functions.update_calibration);
    return functions;
}
} // namespace

HdConsequence consequence_of(std::uint32_t error_code)
{
    switch (error_code)
    {
    case hd::error::warm_motors:
    case hd::error::exceeded_max_force:
    case hd::error::exceeded_max_force_impulse:
    case hd::error::exceeded_max_velocity:
    case hd::error::force_error:
        return HdConsequence::pause;
    case hd::error::bad_handle:
    case hd::error::device_fault:
    case hd::error::device_already_initiated:
    case hd::error::comm_error:
    case hd::error::comm_config_error:
    case hd::error::timer_error:
        return HdConsequence::lost;
    default:
        return HdConsequence::failed;
    }
}

const char *name_of_hd_error(std::uint32_t error_code)
{
    struct Name
    {
        std::uint32_t code;
        const char *name;
    };
    static constexpr Name names[] = {{hd::error::success, "HD_SUCCESS"},
                                     {hd::error::invalid_enum, "HD_INVALID_ENUM"},
                                     {hd::error::invalid_value, "HD_INVALID_VALUE"},
                                     {hd::error::invalid_operation, "HD_INVALID_OPERATION"},
                                     {hd::error::invalid_input_type, "HD_INVALID_INPUT_TYPE"},
                                     {hd::error::bad_handle, "HD_BAD_HANDLE"},
                                     {hd::error::warm_motors, "HD_WARM_MOTORS"},
                                     {hd::error::exceeded_max_force, "HD_EXCEEDED_MAX_FORCE"},
                                     {hd::error::exceeded_max_force_impulse, "HD_EXCEEDED_MAX_FORCE_IMPULSE"},
                                     {hd::error::exceeded_max_velocity, "HD_EXCEEDED_MAX_VELOCITY"},
                                     {hd::error::force_error, "HD_FORCE_ERROR"},
                                     {hd::error::device_fault, "HD_DEVICE_FAULT"},
                                     {hd::error::device_already_initiated, "HD_DEVICE_ALREADY_INITIATED"},
                                     {hd::error::comm_error, "HD_COMM_ERROR"},
                                     {hd::error::comm_config_error, "HD_COMM_CONFIG_ERROR"},
                                     {hd::error::timer_error, "HD_TIMER_ERROR"},
                                     {hd::error::frame_error, "HD_FRAME_ERROR"},
                                     {hd::error::scheduler_full, "HD_SCHEDULER_FULL"},
                                     {hd::error::invalid_license, "HD_INVALID_LICENSE"}};
    for (const Name &each : names)
        if (each.code == error_code)
            return each.name;
    return "unknown error";
}

HdLibrary::HdLibrary(const std::vector<std::string> &files) : handle_(load_first_of(files))
{
    try
    {
        functions_ = functions_in(handle_);
    }
    catch (...)
    {
        dlclose(handle_);
        throw;
    }
}

HdLibrary::~HdLibrary()
{
    dlclose(handle_);
}

hd::ErrorInfo HdLibrary::take_errors() const
{
    hd::ErrorInfo gravest{hd::error::success, 0, hd::invalid_handle};
    for (int taken = 0; taken < most_errors_at_once; ++taken)
    {
        const hd::ErrorInfo error = functions_.get_error();
        if (error.code == hd::error::success)
            break;
        // The newest comes first: of two as grave, the later one of this loop is the older.
        const bool is_pause = consequence_of(error.code) == HdConsequence::pause;
        if (!is_pause || gravest.code == hd::error::success || consequence_of(gravest.code) == HdConsequence::pause)
            gravest = error;
    }
    return gravest;
}

std::string HdLibrary::describe(std::uint32_t error_code, int internal_code) const
{
    char code[64];
    std::snprintf(code, sizeof code, " (0x%X, internal code %d)", static_cast<unsigned>(error_code), internal_code);
    const char *words = functions_.get_error_string(error_code);
    return name_of_hd_error(error_code) + std::string(code) + (words != nullptr ? std::string(": ") + words : "");
}
} // namespace ode_predictive_space::haptics
