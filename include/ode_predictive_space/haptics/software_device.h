// What the devices without a driver have in common.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SOFTWARE_DEVICE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SOFTWARE_DEVICE_H

#include "ode_predictive_space/haptics/device.h"

#include <optional>

namespace ode_predictive_space::haptics
{
/// A device that is made of software: it can always be opened, unless start() objects, and moves by the time that read() is
/// given. Its motion begins at the first read() after open(), whatever the loop's clock shows then.
class SoftwareDevice : public Device
{
public:
    void open() override;
    void close() noexcept override;
    const Capabilities &capabilities() const override { return capabilities_; }

    /// @throws std::invalid_argument for a time that is not finite; DeviceError (not_open).
    DeviceState read(double time) override;

    /// @throws DeviceError: not_open; failed for a wrench that is not finite. The last wrench is zero then.
    void write(const Wrench &wrench) override;

    DeviceStatus status() const override;

    /// What was written last; zero before that and after close().
    const Wrench &last_wrench() const { return last_wrench_; }

protected:
    /// Not open.
    explicit SoftwareDevice(Capabilities capabilities) : capabilities_(std::move(capabilities)) {}

    /// Go back to the beginning of the motion. The device is not open if this throws.
    virtual void start() {}

    /// Move on to `seconds` after the first read(), for which it is 0; never less than in the call before. The caller sets
    /// the state's time.
    virtual DeviceState move_to(double seconds) = 0;

    /// Why the device, open, is not ready; empty when it is.
    virtual std::string idle_reason() const { return {}; }

    Capabilities capabilities_; ///< what capabilities() tells

private:
    void check_open(const char *call) const;

    bool open_ = false;
    std::optional<double> first_time_; ///< s; of the first read()
    double last_seconds_ = 0;          ///< since then
    Wrench last_wrench_;
};
} // namespace ode_predictive_space::haptics

#endif
