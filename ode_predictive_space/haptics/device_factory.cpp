#include "ode_predictive_space/haptics/drivers.h"

#include "ode_predictive_space/haptics/hand_path.h"
#include "ode_predictive_space/haptics/mouse_device.h"
#include "ode_predictive_space/haptics/recording.h"
#include "ode_predictive_space/haptics/virtual_device.h"

namespace ode_predictive_space::haptics
{
namespace
{
std::unique_ptr<Device> make_virtual(std::uint64_t seed)
{
    const VirtualDeviceSettings settings;
    HandPathSettings path;
    path.scale = 0.9 * settings.capabilities.workspace.max().x() / path.half_workspace;
    HandPath hand(path, seed);
    hand.draw_ahead();
    return std::make_unique<VirtualDevice>(settings, [hand](double seconds) mutable { return hand.position(seconds); });
}
} // namespace

const std::vector<std::string> &device_names()
{
    static const std::vector<std::string> names = {"virtual",  "hand-path",   "mouse",
                                                   "spacenav", "openhaptics", "replay:FILE"};
    return names;
}

std::unique_ptr<Device> make_device(const std::string &name, std::uint64_t seed)
{
    const std::string replay = "replay:";
    if (name == "virtual")
        return make_virtual(seed);
    if (name == "hand-path")
        return std::make_unique<HandPathDevice>(HandPathSettings(), seed);
    if (name == "mouse")
        return std::make_unique<MouseDevice>();
    if (name == "spacenav")
        return std::make_unique<SpacenavDevice>();
    if (name == "openhaptics")
        return std::make_unique<OpenHapticsDevice>();
    if (name.size() > replay.size() && name.rfind(replay, 0) == 0)
        return std::make_unique<ReplayDevice>(name.substr(replay.size()));
    std::string names;
    for (const std::string &known : device_names())
        names += (names.empty() ? "" : ", ") + known;
    throw std::invalid_argument("no device is called \"" + name + "\"; the names are: " + names);
}
} // namespace ode_predictive_space::haptics
