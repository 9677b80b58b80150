#include "ode_predictive_space/haptics/drivers.h"

#include "ode_predictive_space/haptics/hand_path.h"
#include "ode_predictive_space/haptics/mouse_device.h"
#include "ode_predictive_space/haptics/recording.h"
#include "ode_predictive_space/haptics/virtual_device.h"

namespace ode_predictive_space::haptics
{
namespace
{
const std::string replay_prefix = "replay:";

std::unique_ptr<Device> make_virtual(std::uint64_t seed)
{
    const VirtualDeviceSettings settings;
    HandPathSettings path;
    path.scale = 0.9 * settings.capabilities.workspace.max().x() / path.half_workspace;
    HandPath hand(path, seed);
    hand.draw_ahead();
    return std::make_unique<VirtualDevice>(settings, [hand](double seconds) mutable { return hand.position(seconds); });
}

std::unique_ptr<Device> make_hand_path(std::uint64_t seed)
{
    return std::make_unique<HandPathDevice>(HandPathSettings(), seed);
}

template <class Kind> std::unique_ptr<Device> make(std::uint64_t)
{
    return std::make_unique<Kind>();
}

struct Entry
{
    const char *name;
    std::unique_ptr<Device> (*make)(std::uint64_t seed);
};

constexpr Entry entries[] = {
    {"virtual", make_virtual},
    {"hand-path", make_hand_path},
    {"mouse", make<MouseDevice>},
    {"spacenav", make<SpacenavDevice>},
    {"openhaptics", make<OpenHapticsDevice>},
};
} // namespace

const std::vector<std::string> &device_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all{replay_prefix + "FILE"};
        for (const Entry &entry : entries)
            all.insert(all.end() - 1, entry.name);
        return all;
    }();
    return names;
}

std::unique_ptr<Device> make_device(const std::string &name, std::uint64_t seed)
{
    if (name.size() > replay_prefix.size() && name.compare(0, replay_prefix.size(), replay_prefix) == 0)
        return std::make_unique<ReplayDevice>(name.substr(replay_prefix.size()));
    for (const Entry &entry : entries)
        if (name == entry.name)
            return entry.make(seed);
    std::string names;
    for (const std::string &known : device_names())
        names += (names.empty() ? "" : ", ") + known;
    throw std::invalid_argument("no device is called \"" + name + "\"; there are: " + names);
}
} // namespace ode_predictive_space::haptics
