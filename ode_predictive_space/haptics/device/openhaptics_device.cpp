#include "ode_predictive_space/haptics/drivers.h"

#include "ode_predictive_space/haptics/device/at_end.h"
#include "ode_predictive_space/haptics/device/hd_servo.h"
#include "ode_predictive_space/haptics/virtual_device.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
using namespace std::chrono_literals;

constexpr auto longest_wait_for_first_frame = 1s;
constexpr auto longest_wait_for_rest = 100ms;

/// Zero force reaches the motors at the end of its frame; the next frame confirms that.
constexpr std::uint64_t frames_for_rest = 2;

constexpr double millimetres_per_metre = 1e3; // the library uses N/mm and mm

std::vector<std::string> files_of(const OpenHapticsSettings &settings)
{
    return settings.library.empty() ? std::vector<std::string>{"libHD.so", "libHD.so.3.0"}
                                    : std::vector<std::string>{settings.library};
}

std::uint32_t frames_in(double seconds, double rate)
{
    return static_cast<std::uint32_t>(std::fmax(1, std::ceil(seconds * rate)));
}

DeviceError hd_error(DeviceFault fault, const std::string &sentence)
{
    return {fault, "OpenHaptics: " + sentence};
}

AtEnd take_scheduler()
{
    static std::atomic<bool> is_taken{false};
    if (is_taken.exchange(true))
        throw hd_error(
            DeviceFault::permission_denied,
            "another device is open in this program, and the library has only one scheduler: close that device first");
    return AtEnd([] { is_taken.store(false); });
}

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
} // namespace

/// An open device. Members are initialised in the order of the steps, and undone in reverse, also when a step fails.
class OpenHapticsDevice::Session
{
public:
    explicit Session(const OpenHapticsSettings &settings)
        : scheduler_taken_(take_scheduler()), library_(files_of(settings)),
          name_(settings.configuration.empty() ? "the default device" : "the device " + settings.configuration),
          handle_(initialise(settings.configuration)), initialised_([this] { switch_off(); }),
          capabilities_(read_capabilities()), servo_(library_, handle_, frames_in(force_timeout, capabilities_.rate),
                                                     frames_in(recovery_time, capabilities_.rate)),
          callback_(library_->schedule_asynchronous(HdServo::callback, &servo_, hd::default_priority)),
          scheduled_([this] { library_->unschedule(callback_); })
    {
        check("the servo cannot be scheduled");
        enable_force_output();
        library_->start_scheduler();
        started_ = AtEnd([this] { stop(); });
        check("the scheduler cannot be started");
        wait_until_ready();
    }

    const Capabilities &capabilities() const { return capabilities_; }

    DeviceState read(double time)
    {
        const HdSample &sample = servo_.read();
        note_silence(sample.frame, time);
        const HdFault begun = servo_.take_pause();
        throw_fault(begun ? begun : servo_.pause());
        DeviceState state = sample.state;
        state.time = time_of_frame_;
        return state;
    }

    void write(const Vector3 &force)
    {
        servo_.write(force.allFinite() ? force : Vector3(Vector3::Zero()));
        throw_fault(servo_.take_pause()); // once, so that the caller can write zero after it
        if (!force.allFinite())
            throw hd_error(DeviceFault::failed, "a force was written that is not finite; none is rendered");
    }

    std::optional<DeviceError> fault() const { return fault_with(servo_.pause()); }

private:
    void check(const std::string &doing) const
    {
        if (const HdFault fault = library_.take_errors())
            throw library_.error(doing, fault);
    }

    hd::Handle initialise(const std::string &configuration) const
    {
        library_.take_errors(); // former errors
        const hd::Handle handle = library_->init_device(configuration.empty() ? nullptr : configuration.c_str());
        const HdFault fault = library_.take_errors();
        if (handle != hd::invalid_handle && !fault)
        {
            library_->make_current_device(handle);
            return handle;
        }
        if (handle != hd::invalid_handle)
            library_->disable_device(handle);
        throw hd_error(fault.code != hd::invalid_license ? DeviceFault::not_found : DeviceFault::failed,
                       name_ + " cannot be initialised: " + library_.describe(fault));
    }

    void switch_off() const
    {
        library_->make_current_device(handle_);
        library_->disable(hd::force_output);
        library_->disable_device(handle_);
    }

    double number(hd::Enum name) const
    {
        double value = 0;
        library_->get_doublev(name, &value);
        return value;
    }

    Capabilities read_capabilities() const
    {
        Capabilities capabilities;
        int rate = 0;
        double corners[6] = {};
        const char *model = library_->get_string(hd::device_model_type);
        library_->get_integerv(hd::update_rate, &rate);
        library_->get_doublev(hd::usable_workspace, corners);
        capabilities.name = model != nullptr ? model : "OpenHaptics device";
        capabilities.input_axes = 6;
        capabilities.force_axes = 3;
        capabilities.max_force = number(hd::nominal_max_force);
        capabilities.max_stiffness = number(hd::nominal_max_stiffness) * millimetres_per_metre;
        capabilities.max_damping = number(hd::nominal_max_damping) * millimetres_per_metre;
        capabilities.workspace = {Vector3(corners) / millimetres_per_metre,
                                  Vector3(corners + 3) / millimetres_per_metre};
        check("the capabilities of " + name_ + " cannot be read");
        // Some drivers measure the rate, and report 0 before their servo runs.
        capabilities.rate = rate > 0 ? rate : 1000;
        return capabilities;
    }

    void enable_force_output() const
    {
        library_->enable(hd::max_force_clamping);
        library_->enable(hd::force_ramping);
        library_->enable(hd::force_output);
        check("the force output of " + name_ + " cannot be switched on");
    }

    void wait_until_ready()
    {
        if (!wait_for([this] { return servo_.read().frame > 0; }, longest_wait_for_first_frame))
            throw hd_error(DeviceFault::failed, "the scheduler was started, but its servo thread does not run");
        throw_fault({});
        if (servo_.read().calibration != hd::calibration_ok)
            throw hd_error(DeviceFault::not_calibrated,
                           "the device is not calibrated: put its stylus into the inkwell, or its arm into the neutral "
                           "position, or calibrate it with the vendor's tool, and open it again");
    }

    /// Sets zero force and waits for one more frame before the scheduler stops.
    void stop()
    {
        servo_.rest();
        // If the servo thread hangs, switch_off() removes the force.
        wait_for([this] { return servo_.frames_at_rest() >= frames_for_rest; }, longest_wait_for_rest);
        library_->stop_scheduler();
    }

    void note_silence(std::uint64_t frame, double time)
    {
        if (frame != frame_)
        {
            frame_ = frame;
            time_of_frame_ = time;
        }
        else if (time - time_of_frame_ > silence_timeout)
        {
            is_silent_ = true;
            servo_.rest(); // in case it continues
        }
    }

    std::optional<DeviceError> fault_with(const HdFault &pause) const
    {
        if (const HdFault end = servo_.end())
            return library_.error("the servo thread has ended", end);
        if (is_silent_)
            return hd_error(DeviceFault::lost, "the servo thread does not run any more");
        if (pause)
            return library_.error("no force is rendered for a while", pause);
        return std::nullopt;
    }

    void throw_fault(const HdFault &pause) const
    {
        if (const auto fault = fault_with(pause))
            throw DeviceError(*fault);
    }

    AtEnd scheduler_taken_;
    HdLibrary library_;
    std::string name_; ///< for messages
    hd::Handle handle_;
    AtEnd initialised_;
    Capabilities capabilities_;
    HdServo servo_;
    hd::SchedulerHandle callback_;
    AtEnd scheduled_;
    AtEnd started_;

    std::uint64_t frame_ = 0;
    double time_of_frame_ = 0;
    bool is_silent_ = false;
};

// Capabilities of the weakest known device until open().
OpenHapticsDevice::OpenHapticsDevice(OpenHapticsSettings settings)
    : settings_(std::move(settings)), capabilities_(device_preset("Touch"))
{
    capabilities_.name = "OpenHaptics device";
    capabilities_.input_axes = 6;
}

OpenHapticsDevice::~OpenHapticsDevice() = default;

void OpenHapticsDevice::open()
{
    if (session_ == nullptr)
    {
        session_ = std::make_unique<Session>(settings_);
        capabilities_ = session_->capabilities();
    }
}

void OpenHapticsDevice::close() noexcept
{
    session_.reset();
}

DeviceState OpenHapticsDevice::read(double time)
{
    if (session_ == nullptr)
        throw hd_error(DeviceFault::not_open, "read() needs open()");
    return session_->read(time);
}

void OpenHapticsDevice::write(const Wrench &wrench)
{
    if (session_ == nullptr)
        throw hd_error(DeviceFault::not_open, "write() needs open()");
    session_->write(wrench.force);
}

DeviceStatus OpenHapticsDevice::status() const
{
    if (session_ == nullptr)
        return {false, false, "the device is not open"};
    const auto fault = session_->fault();
    return {true, !fault, fault ? fault->what() : ""};
}
} // namespace ode_predictive_space::haptics
