#include "demos/haptic/demo_device.h"

#include "ode_predictive_space/haptics/device_factory.h"
#include "ode_predictive_space/haptics/hand_path_device.h"
#include "ode_predictive_space/haptics/virtual_device.h"

namespace ode_predictive_space::demo
{
namespace
{
constexpr double hand_size = 0.95; // of the workspace; targets lie in it

std::unique_ptr<haptics::Device> make_virtual_device(std::uint64_t seed)
{
    const haptics::VirtualDeviceSettings settings;
    haptics::HandPathSettings path;
    path.scale = hand_size * settings.capabilities.workspace.max().x() / path.half_workspace;
    haptics::HandPath hand(path, seed);
    hand.reach_times(600); // draws them, which takes memory, before the servo loop runs
    return std::make_unique<haptics::VirtualDevice>(settings,
                                                    [hand](double seconds) mutable { return hand.position(seconds); });
}
} // namespace

haptics::DeviceState DemoDevice::read(double time)
{
    haptics::DeviceState state = device_->read(time);
    if (clutch_held())
    {
        state.buttons |= 1u << clutch_button;
    }
    return state;
}

std::unique_ptr<haptics::Device> make_seeded_device(const std::string &name, std::uint64_t seed)
{
    if (name == "virtual")
    {
        return make_virtual_device(seed);
    }
    if (name == "hand-path")
    {
        return std::make_unique<haptics::HandPathDevice>(haptics::HandPathSettings{}, seed);
    }
    return haptics::make_device(name);
}
} // namespace ode_predictive_space::demo
