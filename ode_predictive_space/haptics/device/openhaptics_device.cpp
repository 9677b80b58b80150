#include "ode_predictive_space/haptics/drivers.h"

#include "ode_predictive_space/haptics/device/hd_session.h"

#include <atomic>
#include <cmath>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
std::vector<std::string> files_of(const OpenHapticsSettings &settings)
{
    return settings.library.empty() ? std::vector<std::string>{"libHD.so", "libHD.so.3.0"}
                                    : std::vector<std::string>{settings.library};
}

std::uint32_t frames_in(double seconds, double rate)
{
    return static_cast<std::uint32_t>(std::fmax(1, std::ceil(seconds * rate)));
}
} // namespace

/// From open() to close(). The order of the members is the order of the steps; at the end, and when a step fails, those
/// that were taken are undone in the opposite order.
class OpenHapticsDevice::Session
{
public:
    explicit Session(const OpenHapticsSettings &settings)
        : library_(files_of(settings)), device_(library_, settings.configuration),
          capabilities_(device_.read_capabilities()),
          servo_(library_, device_.handle(), frames_in(force_timeout, capabilities_.rate),
                 frames_in(recovery_time, capabilities_.rate)),
          schedule_(library_, servo_), scheduler_(library_, device_, servo_)
    {}

    const Capabilities &capabilities() const { return capabilities_; }

    DeviceState read(double time)
    {
        const HdSample &sample = servo_.read();
        note_silence(sample.frame, time);
        const HdFault begun = servo_.take_pause();
        throw_faults(begun ? begun : servo_.pause());
        DeviceState state = sample.state;
        state.time = time_of_frame_;
        return state;
    }

    void write(const Vector3 &force)
    {
        servo_.write(force.allFinite() ? force : Vector3(Vector3::Zero()));
        throw_faults(servo_.take_pause()); // once: a caller that writes zero because of it has done what is to be done
        if (!force.allFinite())
        {
            throw DeviceError(DeviceFault::failed,
                              "OpenHaptics: a force was written that is not finite; none is rendered");
        }
    }

    std::string what_is_wrong() const
    {
        if (const HdFault end = servo_.end())
            return "the servo thread has ended: " + library_.describe(end.code, end.internal_code);
        if (is_silent_)
            return silence;
        if (const HdFault pause = servo_.pause())
            return "no force is rendered for a while: " + library_.describe(pause.code, pause.internal_code);
        return {};
    }

private:
    /// The library has one scheduler, and stopping it for one device would stop it for all.
    class OnlyOne
    {
    public:
        OnlyOne()
        {
            if (is_taken.exchange(true))
            {
                throw DeviceError(
                    DeviceFault::permission_denied,
                    "OpenHaptics: another device is open in this program, and the library has but one scheduler");
            }
        }
        ~OnlyOne() { is_taken.store(false); }
        OnlyOne(const OnlyOne &) = delete;
        OnlyOne &operator=(const OnlyOne &) = delete;

    private:
        static inline std::atomic<bool> is_taken{false};
    };

    static constexpr const char *silence = "the servo thread runs no more";

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
            servo_.rest(); // should it run again
        }
    }

    /// @throws DeviceError for an end or silence, or a pause if there is one.
    void throw_faults(const HdFault &pause)
    {
        if (const HdFault end = servo_.end())
            throw hd_error(library_, "the servo thread has ended", end.code, end.internal_code);
        if (is_silent_)
            throw DeviceError(DeviceFault::lost, std::string("OpenHaptics: ") + silence);
        if (pause)
            throw hd_error(library_, "no force is rendered for a while", pause.code, pause.internal_code);
    }

    OnlyOne only_one_;
    HdLibrary library_;
    HdDevice device_;
    Capabilities capabilities_;
    HdServo servo_;
    HdSchedule schedule_;
    HdScheduler scheduler_;

    std::uint64_t frame_ = 0;
    double time_of_frame_ = 0;
    bool is_silent_ = false;
};

OpenHapticsDevice::OpenHapticsDevice(OpenHapticsSettings settings) : settings_(std::move(settings))
{
    // The least of those that are in the field, until open() asks the device.
    capabilities_.name = "OpenHaptics device";
    capabilities_.input_axes = 6;
    capabilities_.max_force = 3.3;
    capabilities_.max_stiffness = 400;
    capabilities_.max_damping = 4;
    capabilities_.workspace = {Vector3::Constant(-0.075), Vector3::Constant(0.075)};
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

const Capabilities &OpenHapticsDevice::capabilities() const
{
    return capabilities_;
}

DeviceState OpenHapticsDevice::read(double time)
{
    if (session_ == nullptr)
        throw DeviceError(DeviceFault::not_open, "OpenHaptics: read() needs open()");
    return session_->read(time);
}

void OpenHapticsDevice::write(const Wrench &wrench)
{
    if (session_ == nullptr)
        throw DeviceError(DeviceFault::not_open, "OpenHaptics: write() needs open()");
    session_->write(wrench.force);
}

DeviceStatus OpenHapticsDevice::status() const
{
    if (session_ == nullptr)
        return {false, false, "the device is not open"};
    const std::string what_is_wrong = session_->what_is_wrong();
    return {true, what_is_wrong.empty(), what_is_wrong};
}
} // namespace ode_predictive_space::haptics
