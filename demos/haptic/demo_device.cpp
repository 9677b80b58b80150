#include "demos/haptic/demo_device.h"

namespace ode_predictive_space::demo
{
haptics::DeviceState DemoDevice::read(double time)
{
    haptics::DeviceState state = device_->read(time);
    if (clutch_held())
        state.buttons |= 1u << clutch_button;
    return state;
}
} // namespace ode_predictive_space::demo
