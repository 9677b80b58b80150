#include "ode_predictive_space/haptics/device/hd_session.h"

#include <chrono>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
using namespace std::chrono_literals;

constexpr auto longest_wait_for_first_frame = 1s;
constexpr auto longest_wait_for_rest = 100ms;

/// Zero is set in one frame and reaches the motors at its end; the next one proves that it got there.
constexpr std::uint64_t frames_for_rest = 2;

// The library tells N/mm, mm.
constexpr double millimetres_per_metre = 1e3;

/// @return whether it came true in time.
template <typename Condition> bool wait_for(Condition is_true, std::chrono::milliseconds longest)
{
    const auto end = std::chrono::steady_clock::now() + longest;
    while (!is_true())
    {
        if (std::chrono::steady_clock::now() > end)
            return false;
        std::this_thread::sleep_for(200us);
    }
    return true;
}

/// @throws DeviceError when the library has an error to tell.
void check(const HdLibrary &library, const std::string &doing)
{
    const hd::ErrorInfo error = library.take_errors();
    if (error.code != hd::error::success)
        throw hd_error(library, doing, error.code, error.internal_code);
}

double number(const HdLibrary &library, hd::Enum name)
{
    double value = 0;
    library->get_doublev(name, &value);
    return value;
}

Eigen::AlignedBox3d workspace(const HdLibrary &library)
{
    double corners[6] = {};
    library->get_doublev(hd::usable_workspace, corners);
    return {Vector3(corners[0], corners[1], corners[2]) / millimetres_per_metre,
            Vector3(corners[3], corners[4], corners[5]) / millimetres_per_metre};
}
} // namespace

DeviceError hd_error(const HdLibrary &library, const std::string &doing, std::uint32_t code, int internal_code)
{
    const auto fault = consequence_of(code) == HdConsequence::lost ? DeviceFault::lost : DeviceFault::failed;
    return {fault, "OpenHaptics: " + doing + ": " + library.describe(code, internal_code)};
}

// --- HdDevice
// -------------------------------------------------------------------------------------------------------------

HdDevice::HdDevice(const HdLibrary &library, const std::string &configuration)
    : library_(library), configuration_(configuration.empty() ? "the default device" : "the device " + configuration)
{
    library_.take_errors(); // left over from before
    handle_ = library_->init_device(configuration.empty() ? nullptr : configuration.c_str());
    const hd::ErrorInfo error = library_.take_errors();
    if (handle_ != hd::invalid_handle && error.code == hd::error::success)
    {
        library_->make_current_device(handle_);
        return;
    }
    if (handle_ != hd::invalid_handle)
        library_->disable_device(handle_);
    const bool is_licensed = error.code != hd::error::invalid_license;
    throw DeviceError(is_licensed ? DeviceFault::not_found : DeviceFault::failed,
                      "OpenHaptics: " + configuration_ +
                          " cannot be initialised: " + library_.describe(error.code, error.internal_code));
}

HdDevice::~HdDevice()
{
    library_->make_current_device(handle_);
    library_->disable(hd::force_output);
    library_->disable_device(handle_);
}

Capabilities HdDevice::read_capabilities() const
{
    Capabilities capabilities;
    int rate = 0;
    const char *model = library_->get_string(hd::device_model_type);
    library_->get_integerv(hd::update_rate, &rate);
    capabilities.name = model != nullptr ? model : "OpenHaptics device";
    capabilities.input_axes = 6;
    capabilities.force_axes = 3;
    capabilities.max_force = number(library_, hd::nominal_max_force);
    capabilities.max_stiffness = number(library_, hd::nominal_max_stiffness) * millimetres_per_metre;
    capabilities.max_damping = number(library_, hd::nominal_max_damping) * millimetres_per_metre;
    capabilities.workspace = workspace(library_);
    check(library_, "what " + configuration_ + " can do cannot be read");
    // Some drivers measure the rate and have nothing to tell before their servo runs.
    capabilities.rate = rate > 0 ? rate : 1000;
    return capabilities;
}

void HdDevice::enable_force_output() const
{
    library_->enable(hd::max_force_clamping);
    library_->enable(hd::force_ramping);
    library_->enable(hd::force_output);
    check(library_, "the force output of " + configuration_ + " cannot be switched on");
}

// --- HdSchedule
// -----------------------------------------------------------------------------------------------------------

HdSchedule::HdSchedule(const HdLibrary &library, HdServo &servo)
    : library_(library), handle_(library->schedule_asynchronous(HdServo::callback, &servo, hd::default_priority))
{
    const hd::ErrorInfo error = library_.take_errors();
    if (error.code != hd::error::success)
    {
        library_->unschedule(handle_);
        throw hd_error(library_, "the servo cannot be scheduled", error.code, error.internal_code);
    }
}

// --- HdScheduler
// ----------------------------------------------------------------------------------------------------------

HdScheduler::HdScheduler(const HdLibrary &library, const HdDevice &device, HdServo &servo)
    : library_(library), servo_(servo)
{
    device.enable_force_output();
    library_->start_scheduler();
    try
    {
        check(library_, "the scheduler cannot be started");
        wait_until_ready();
    }
    catch (...)
    {
        stop();
        throw;
    }
}

void HdScheduler::wait_until_ready() const
{
    if (!wait_for([this] { return servo_.frames() > 0; }, longest_wait_for_first_frame))
    {
        throw DeviceError(DeviceFault::failed,
                          "OpenHaptics: the scheduler was started and its servo thread does not run");
    }
    if (const HdFault end = servo_.end())
        throw hd_error(library_, "the servo thread has ended", end.code, end.internal_code);
    if (servo_.calibration() != hd::calibration_ok)
    {
        throw DeviceError(
            DeviceFault::not_calibrated,
            "OpenHaptics: the device is not calibrated: put its stylus into the inkwell, or its arm into the "
            "neutral position, or calibrate it with the vendor's tool, and open it again");
    }
}

void HdScheduler::stop()
{
    servo_.rest();
    // When the servo thread stands still, the device switches its force output off instead.
    wait_for([this] { return servo_.frames_at_rest() >= frames_for_rest; }, longest_wait_for_rest);
    library_->stop_scheduler();
}
} // namespace ode_predictive_space::haptics
