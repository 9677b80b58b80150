// OpenHaptics' HD library, loaded at run time: the used part of its binary interface, and the meaning of its errors.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_HD_LIBRARY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_HD_LIBRARY_H

#include "ode_predictive_space/haptics/device.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ode_predictive_space::haptics::hd
{
using Handle = std::uint32_t;
using Enum = std::uint32_t;
using SchedulerHandle = unsigned long;
using Callback = std::uint32_t (*)(void *);

struct ErrorInfo
{
    std::uint32_t code;
    int internal_code;
    Handle device;
};
static_assert(sizeof(ErrorInfo) == 12, "the library's HDErrorInfo");

constexpr Handle invalid_handle = 0xFFFFFFFF;
constexpr std::uint32_t callback_continue = 1;
constexpr std::uint16_t default_priority = 32767;

// Queries of each frame; lengths in mm, the transform as 16 doubles in column order.
constexpr Enum current_buttons = 0x2000;
constexpr Enum current_position = 0x2050;
constexpr Enum current_velocity = 0x2051;
constexpr Enum current_transform = 0x2052;
constexpr Enum current_angular_velocity = 0x2053;
constexpr Enum current_force = 0x2700;

// Constant properties; stiffness in N/mm, damping in N s/mm.
constexpr Enum device_model_type = 0x2501;
constexpr Enum usable_workspace = 0x2551;
constexpr Enum calibration_style = 0x2555;
constexpr Enum update_rate = 0x2600;
constexpr Enum nominal_max_stiffness = 0x2602;
constexpr Enum nominal_max_force = 0x2603;
constexpr Enum nominal_max_damping = 0x2609;

constexpr Enum force_output = 0x4000;
constexpr Enum max_force_clamping = 0x4001;
constexpr Enum force_ramping = 0x4002;

constexpr Enum calibration_ok = 0x5000;
constexpr Enum calibration_needs_update = 0x5001;

// Errors that are compared by number; hd_library.cpp has the others.
constexpr std::uint32_t success = 0;
constexpr std::uint32_t invalid_license = 0x600;

/// The address of a function, which converts to the declared type.
struct Symbol
{
    void *address;
    template <typename Function> operator Function *() const { return reinterpret_cast<Function *>(address); }
};

Symbol symbol_of(void *library, const char *name);

struct Loaded
{
    explicit Loaded(void *handle) : library(handle) {}

    void *library;
};

/// Functions of the servo's frames; some serve the open device, too.
struct FrameFunctions : Loaded
{
    using Loaded::Loaded;

    void (*begin_frame)(Handle) = symbol_of(library, "hdBeginFrame");
    void (*end_frame)(Handle) = symbol_of(library, "hdEndFrame");
    void (*get_doublev)(Enum, double *) = symbol_of(library, "hdGetDoublev");
    void (*get_integerv)(Enum, int *) = symbol_of(library, "hdGetIntegerv");
    void (*set_doublev)(Enum, const double *) = symbol_of(library, "hdSetDoublev");
    Enum (*check_calibration)() = symbol_of(library, "hdCheckCalibration");
    void (*update_calibration)(Enum style) = symbol_of(library, "hdUpdateCalibration");
};

struct Functions : FrameFunctions
{
    using FrameFunctions::FrameFunctions;

    Handle (*init_device)(const char *configuration) = symbol_of(library, "hdInitDevice");
    void (*disable_device)(Handle) = symbol_of(library, "hdDisableDevice");
    void (*make_current_device)(Handle) = symbol_of(library, "hdMakeCurrentDevice");
    ErrorInfo (*get_error)() = symbol_of(library, "hdGetError"); ///< takes the newest error off the library's stack
    const char *(*get_error_string)(std::uint32_t code) = symbol_of(library, "hdGetErrorString");
    const char *(*get_string)(Enum) = symbol_of(library, "hdGetString");
    void (*enable)(Enum) = symbol_of(library, "hdEnable");
    void (*disable)(Enum) = symbol_of(library, "hdDisable");
    void (*start_scheduler)() = symbol_of(library, "hdStartScheduler");
    void (*stop_scheduler)() = symbol_of(library, "hdStopScheduler");
    SchedulerHandle (*schedule_asynchronous)(Callback, void *data,
                                             std::uint16_t priority) = symbol_of(library, "hdScheduleAsynchronous");
    void (*unschedule)(SchedulerHandle) = symbol_of(library, "hdUnschedule");
};
} // namespace ode_predictive_space::haptics::hd

namespace ode_predictive_space::haptics
{
enum class HdConsequence
{
    pause, ///< no force for a while
    lost,  ///< the device answers no more
    failed ///< the library cannot go on
};

HdConsequence consequence_of(std::uint32_t error_code);

/// The name in the library's header, such as "HD_WARM_MOTORS"; "unknown error" for other codes.
const char *name_of_hd_error(std::uint32_t error_code);

/// An error of the library, or none. It has 64 bits, for lock-free access.
struct alignas(8) HdFault
{
    std::uint32_t code = hd::success;
    int internal_code = 0;

    explicit operator bool() const { return code != hd::success; }
};

/// The library, which is never unloaded because its threads may continue.
class HdLibrary
{
public:
    /// @throws DeviceError missing_library with the linker's words for each of the files; missing_symbol.
    explicit HdLibrary(const std::vector<std::string> &files);

    const hd::Functions *operator->() const { return &functions_; }

    /// @return the oldest error that is more than a pause, otherwise the oldest error, if any.
    HdFault take_errors() const;

    /// A text such as "HD_WARM_MOTORS (0x200, internal code 5): ", with the library's explanation.
    std::string describe(const HdFault &fault) const;

    DeviceError error(const std::string &doing, const HdFault &fault) const;

private:
    hd::Functions functions_;
};
} // namespace ode_predictive_space::haptics

#endif
