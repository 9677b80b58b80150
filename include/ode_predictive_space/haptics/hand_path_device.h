// A device that a hand of its own moves, and that renders no force.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_HAND_PATH_DEVICE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_HAND_PATH_DEVICE_H

#include "ode_predictive_space/haptics/hand_path.h"
#include "ode_predictive_space/haptics/software_device.h"

namespace ode_predictive_space::haptics
{
/// The handle follows a HandPath: reaches of least jerk, with tremor. The same settings, seed and times give the same
/// states. Forces are accepted and have no effect: see VirtualDevice for a hand that gives way.
class HandPathDevice : public SoftwareDevice
{
public:
    /// Not open. The arguments are those of HandPath.
    explicit HandPathDevice(const HandPathSettings &settings = {}, std::uint64_t seed = 1);

protected:
    void start() override;
    DeviceState move_to(double seconds) override;

private:
    HandPath path_;
};
} // namespace ode_predictive_space::haptics

#endif
