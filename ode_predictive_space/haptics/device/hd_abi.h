// The part of the binary interface of OpenHaptics' HD library that we use: our own declarations of types, numbers,
// functions.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_HD_ABI_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_HD_ABI_H

#include <cstdint>

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

namespace error
{
constexpr std::uint32_t success = 0;
constexpr std::uint32_t invalid_enum = 0x100;
constexpr std::uint32_t invalid_value = 0x101;
constexpr std::uint32_t invalid_operation = 0x102;
constexpr std::uint32_t invalid_input_type = 0x103;
constexpr std::uint32_t bad_handle = 0x104;
constexpr std::uint32_t warm_motors = 0x200;
constexpr std::uint32_t exceeded_max_force = 0x201;
constexpr std::uint32_t exceeded_max_force_impulse = 0x202;
constexpr std::uint32_t exceeded_max_velocity = 0x203;
constexpr std::uint32_t force_error = 0x204;
constexpr std::uint32_t device_fault = 0x300;
constexpr std::uint32_t device_already_initiated = 0x301;
constexpr std::uint32_t comm_error = 0x302;
constexpr std::uint32_t comm_config_error = 0x303;
constexpr std::uint32_t timer_error = 0x304;
constexpr std::uint32_t frame_error = 0x402;
constexpr std::uint32_t scheduler_full = 0x501;
constexpr std::uint32_t invalid_license = 0x600;
} // namespace error

/// The library's functions, hdInitDevice and so on, by our names.
struct Functions
{
    Handle (*init_device)(const char *configuration);
    void (*disable_device)(Handle);
    void (*make_current_device)(Handle);
    void (*begin_frame)(Handle);
    void (*end_frame)(Handle);
    ErrorInfo (*get_error)(); ///< takes the newest error off the library's stack
    const char *(*get_error_string)(std::uint32_t code);
    const char *(*get_string)(Enum);
    void (*enable)(Enum);
    void (*disable)(Enum);
    void (*get_doublev)(Enum, double *);
    void (*get_integerv)(Enum, int *);
    void (*set_doublev)(Enum, const double *);
    void (*start_scheduler)();
    void (*stop_scheduler)();
    SchedulerHandle (*schedule_asynchronous)(Callback, void *data, std::uint16_t priority);
    void (*unschedule)(SchedulerHandle);
    Enum (*check_calibration)();
    void (*update_calibration)(Enum style);
};
} // namespace ode_predictive_space::haptics::hd

#endif
