// OpenHaptics' HD library, loaded at run time: what of its binary interface we use, by our own declarations of types, numbers and
// functions, and what its errors mean to us.

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
using Boolean = std::uint8_t;
using SchedulerHandle = unsigned long;
using Callback = std::uint32_t (*)(void *);

/// Returned by value.
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

// What the servo asks for in each frame. Lengths in mm, the rotation's 16 doubles column by column.
constexpr Enum current_buttons = 0x2000;
constexpr Enum current_position = 0x2050;
constexpr Enum current_velocity = 0x2051;
constexpr Enum current_transform = 0x2052;
constexpr Enum current_angular_velocity = 0x2053;
constexpr Enum current_force = 0x2700;

// What does not change while the device is in use. Stiffness in N/mm, damping in N s/mm.
constexpr Enum device_model_type = 0x2501;
constexpr Enum usable_workspace = 0x2551;
constexpr Enum calibration_style = 0x2555;
constexpr Enum update_rate = 0x2600;
constexpr Enum nominal_max_stiffness = 0x2602;
constexpr Enum nominal_max_force = 0x2603;
constexpr Enum nominal_max_damping = 0x2609;

// For enable() and disable().
constexpr Enum force_output = 0x4000;
constexpr Enum max_force_clamping = 0x4001;
constexpr Enum force_ramping = 0x4002;

// Answers of check_calibration().
constexpr Enum calibration_ok = 0x5000;
constexpr Enum calibration_needs_update = 0x5001;

// Errors that are asked for by their numbers; the others are in hd_library.cpp.
constexpr std::uint32_t success = 0;
constexpr std::uint32_t invalid_license = 0x600;

/// Where a function of the library is; becomes a pointer of the type that is declared for it.
struct Symbol
{
    void *address;
    template <typename Function> operator Function *() const { return reinterpret_cast<Function *>(address); }
};

/// @throws DeviceError missing_symbol.
Symbol symbol_of(void *library, const char *name);

/// The library's functions by our names.
struct Functions
{
    explicit Functions(void *loaded) : library(loaded) {}

    void *library;
    Handle (*init_device)(const char *configuration) = symbol_of(library, "hdInitDevice");
    void (*disable_device)(Handle) = symbol_of(library, "hdDisableDevice");
    void (*make_current_device)(Handle) = symbol_of(library, "hdMakeCurrentDevice");
    void (*begin_frame)(Handle) = symbol_of(library, "hdBeginFrame");
    void (*end_frame)(Handle) = symbol_of(library, "hdEndFrame");
    ErrorInfo (*get_error)() = symbol_of(library, "hdGetError"); ///< takes the newest error off the library's stack
    const char *(*get_error_string)(std::uint32_t code) = symbol_of(library, "hdGetErrorString");
    const char *(*get_string)(Enum) = symbol_of(library, "hdGetString");
    void (*enable)(Enum) = symbol_of(library, "hdEnable");
    void (*disable)(Enum) = symbol_of(library, "hdDisable");
    void (*get_doublev)(Enum, double *) = symbol_of(library, "hdGetDoublev");
    void (*get_integerv)(Enum, int *) = symbol_of(library, "hdGetIntegerv");
    void (*set_doublev)(Enum, const double *) = symbol_of(library, "hdSetDoublev");
    void (*start_scheduler)() = symbol_of(library, "hdStartScheduler");
    void (*stop_scheduler)() = symbol_of(library, "hdStopScheduler");
    SchedulerHandle (*schedule_asynchronous)(Callback, void *data,
                                             std::uint16_t priority) = symbol_of(library, "hdScheduleAsynchronous");
    void (*unschedule)(SchedulerHandle) = symbol_of(library, "hdUnschedule");
    Enum (*check_calibration)() = symbol_of(library, "hdCheckCalibration");
    void (*update_calibration)(Enum style) = symbol_of(library, "hdUpdateCalibration");
};
} // namespace ode_predictive_space::haptics::hd

namespace ode_predictive_space::haptics
{
/// What an error in the servo thread leads to.
enum class HdConsequence
{
    pause, ///< no force for a while
    lost,  ///< the device answers no more
    failed ///< the library cannot go on
};

HdConsequence consequence_of(std::uint32_t error_code);

/// As in the library's own header, "HD_WARM_MOTORS"; "unknown error" for a code that is not known.
const char *name_of_hd_error(std::uint32_t error_code);

/// An error of the library, or none. Read and written as one number of 64 bits.
struct alignas(8) HdFault
{
    std::uint32_t code = hd::success;
    int internal_code = 0;

    explicit operator bool() const { return code != hd::success; }
};

/// The library. It stays in the process for good: it may have threads that run on.
class HdLibrary
{
public:
    /// Loads the first of the files that can be loaded.
    ///
    /// @throws DeviceError missing_library with the linker's words for each of the files; missing_symbol.
    explicit HdLibrary(const std::vector<std::string> &files);

    const hd::Functions *operator->() const { return &functions_; }

    /// Takes all errors off the library's stack.
    ///
    /// @return the oldest of those that are more than a pause, which others follow from; if there is none, the oldest;
    /// if there is none at all, none.
    HdFault take_errors() const;

    /// "HD_WARM_MOTORS (0x200, internal code 5): " and what the library says of it.
    std::string describe(const HdFault &fault) const;

    /// What the fault is to those who read and write.
    DeviceError error(const std::string &doing, const HdFault &fault) const;

private:
    hd::Functions functions_;
};
} // namespace ode_predictive_space::haptics

#endif
