#include "ode_predictive_space/haptics/hand_path.h"

namespace ode_predictive_space::haptics
{
namespace
{
Capabilities capabilities_of(const HandPathSettings &settings, double half_extent)
{
    Capabilities capabilities;
    capabilities.name = "hand path";
    capabilities.force_axes = 0;
    const Vector3 half = Vector3::Constant(half_extent);
    capabilities.workspace = {settings.centre - half, settings.centre + half};
    return capabilities;
}
} // namespace

HandPathDevice::HandPathDevice(const HandPathSettings &settings, std::uint64_t seed)
    : SoftwareDevice(capabilities_of(settings, HandPath(settings, seed).half_extent())), path_(settings, seed)
{}

void HandPathDevice::start()
{
    path_.draw_ahead();
}

DeviceState HandPathDevice::move_to(double seconds)
{
    DeviceState state;
    state.position = path_.position(seconds);
    state.linear_velocity = path_.velocity(seconds);
    return state;
}
} // namespace ode_predictive_space::haptics
