#include "ode_predictive_space/haptics/device/hd_library.h"

#include <algorithm>
#include <cstdio>
#include <dlfcn.h>
#include <iterator>

namespace ode_predictive_space::haptics
{
namespace
{
/// Maximum of errors in one call, because a recurring error must not block the servo thread.
constexpr int most_errors_at_once = 32;

struct KnownError
{
    std::uint32_t code;
    const char *name;
    HdConsequence consequence;
};

constexpr KnownError known_errors[] = {
    {0x000, "HD_SUCCESS", HdConsequence::failed},
    {0x100, "HD_INVALID_ENUM", HdConsequence::failed},
    {0x101, "HD_INVALID_VALUE", HdConsequence::failed},
    {0x102, "HD_INVALID_OPERATION", HdConsequence::failed},
    {0x103, "HD_INVALID_INPUT_TYPE", HdConsequence::failed},
    {0x104, "HD_BAD_HANDLE", HdConsequence::lost},
    {0x200, "HD_WARM_MOTORS", HdConsequence::pause},
    {0x201, "HD_EXCEEDED_MAX_FORCE", HdConsequence::pause},
    {0x202, "HD_EXCEEDED_MAX_FORCE_IMPULSE", HdConsequence::pause},
    {0x203, "HD_EXCEEDED_MAX_VELOCITY", HdConsequence::pause},
    {0x204, "HD_FORCE_ERROR", HdConsequence::pause},
    {0x300, "HD_DEVICE_FAULT", HdConsequence::lost},
    {0x301, "HD_DEVICE_ALREADY_INITIATED", HdConsequence::lost},
    {0x302, "HD_COMM_ERROR", HdConsequence::lost},
    {0x303, "HD_COMM_CONFIG_ERROR", HdConsequence::lost},
    {0x304, "HD_TIMER_ERROR", HdConsequence::lost},
    {0x402, "HD_FRAME_ERROR", HdConsequence::failed},
    {0x501, "HD_SCHEDULER_FULL", HdConsequence::failed},
    {0x600, "HD_INVALID_LICENSE", HdConsequence::failed},
};

KnownError known_error(std::uint32_t code)
{
    const auto *const found = std::find_if(std::begin(known_errors), std::end(known_errors),
                                           [code](const KnownError &each) { return each.code == code; });
    return found != std::end(known_errors) ? *found : KnownError{code, "unknown error", HdConsequence::failed};
}

void *load_first_of(const std::vector<std::string> &files)
{
    std::string reasons;
    for (const std::string &file : files)
    {
        // Never unloaded: see the class. RTLD_NOW lets a missing symbol fail here, not in the servo thread.
        if (void *handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE))
            return handle;
        reasons += std::string(reasons.empty() ? "" : "; ") + dlerror();
    }
    throw DeviceError(DeviceFault::missing_library, "OpenHaptics: the library cannot be loaded: " + reasons);
}

/// The file of a loaded symbol, after search paths and links.
std::string file_of(void *symbol)
{
    Dl_info info{};
    return symbol != nullptr && dladdr(symbol, &info) != 0 ? info.dli_fname : "the library";
}
} // namespace

hd::Symbol hd::symbol_of(void *library, const char *name)
{
    void *const address = dlsym(library, name);
    if (address == nullptr)
    {
        throw DeviceError(DeviceFault::missing_symbol,
                          "OpenHaptics: " + file_of(dlsym(library, "hdInitDevice")) + " has no function " + name);
    }
    return {address};
}

HdConsequence consequence_of(std::uint32_t error_code)
{
    return known_error(error_code).consequence;
}

const char *name_of_hd_error(std::uint32_t error_code)
{
    return known_error(error_code).name;
}

HdLibrary::HdLibrary(const std::vector<std::string> &files) : functions_(load_first_of(files)) {}

HdFault HdLibrary::take_errors() const
{
    HdFault gravest;
    for (int taken = 0; taken < most_errors_at_once; ++taken)
    {
        const hd::ErrorInfo error = functions_.get_error();
        if (error.code == hd::success)
            break;
        // The newest error comes first, so of equal ones the later in this loop is older.
        const bool is_pause = consequence_of(error.code) == HdConsequence::pause;
        if (!is_pause || !gravest || consequence_of(gravest.code) == HdConsequence::pause)
            gravest = {error.code, error.internal_code};
    }
    return gravest;
}

std::string HdLibrary::describe(const HdFault &fault) const
{
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, " (0x%X, internal code %d)", static_cast<unsigned>(fault.code),
                  fault.internal_code);
    const char *words = functions_.get_error_string(fault.code);
    return name_of_hd_error(fault.code) + std::string(numbers) + (words != nullptr ? std::string(": ") + words : "");
}

DeviceError HdLibrary::error(const std::string &doing, const HdFault &fault) const
{
    const bool is_lost = consequence_of(fault.code) == HdConsequence::lost;
    return {is_lost ? DeviceFault::lost : DeviceFault::failed, "OpenHaptics: " + doing + ": " + describe(fault)};
}
} // namespace ode_predictive_space::haptics
