// A device of OpenHaptics' HD library from its initialisation to its end, whatever happens in between.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_HD_SESSION_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_HD_SESSION_H

#include "ode_predictive_space/haptics/device/hd_servo.h"

#include <string>

namespace ode_predictive_space::haptics
{
/// An initialised device. When it goes its force output is switched off, then the device.
class HdDevice
{
public:
    /// @throws DeviceError not_found; failed without a license.
    HdDevice(const HdLibrary &library, const std::string &configuration);
    ~HdDevice();
    HdDevice(const HdDevice &) = delete;
    HdDevice &operator=(const HdDevice &) = delete;

    hd::Handle handle() const { return handle_; }

    /// @throws DeviceError failed.
    Capabilities read_capabilities() const;

    /// With the library's own limits on it.
    ///
    /// @throws DeviceError failed.
    void enable_force_output() const;

private:
    const HdLibrary &library_;
    const std::string configuration_;
    hd::Handle handle_;
};

/// The servo's callback, as long as it is scheduled.
class HdSchedule
{
public:
    /// @throws DeviceError failed.
    HdSchedule(const HdLibrary &library, HdServo &servo);
    ~HdSchedule() { library_->unschedule(handle_); }
    HdSchedule(const HdSchedule &) = delete;
    HdSchedule &operator=(const HdSchedule &) = delete;

private:
    const HdLibrary &library_;
    hd::SchedulerHandle handle_;
};

/// The library's scheduler, as long as it runs. Before it stops, zero force is set, and seen by one more frame.
class HdScheduler
{
public:
    /// Switches the device's force output on, and returns when the servo has run once and the device is ready.
    ///
    /// @throws DeviceError failed, lost, not_calibrated.
    HdScheduler(const HdLibrary &library, const HdDevice &device, HdServo &servo);
    ~HdScheduler() { stop(); }
    HdScheduler(const HdScheduler &) = delete;
    HdScheduler &operator=(const HdScheduler &) = delete;

private:
    void wait_until_ready() const;
    void stop();

    const HdLibrary &library_;
    HdServo &servo_;
};

/// The error that a fault of the servo is to those who read and write.
DeviceError hd_error(const HdLibrary &library, const std::string &doing, std::uint32_t code, int internal_code);
} // namespace ode_predictive_space::haptics

#endif
