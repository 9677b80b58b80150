// Devices by name, as command lines give them.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_FACTORY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_FACTORY_H

#include "ode_predictive_space/haptics/device.h"

#include <memory>
#include <vector>

namespace ode_predictive_space::haptics
{
/// What make_device() knows: "virtual", "hand-path", "replay:FILE", "mouse", "spacenav", "openhaptics".
const std::vector<std::string> &device_names();

/// A device, not yet open.
///
/// virtual: a VirtualDevice whose hand wants to follow a HandPath in its workspace; hand-path: a HandPathDevice; replay:FILE:
/// a ReplayDevice of that file; mouse: a MouseDevice, which wants to be fed; spacenav: a SpacenavDevice; openhaptics: an
/// OpenHapticsDevice; all with their default settings.
/// @param seed of the hand's path, for the first two.
/// @throws std::invalid_argument for another name; the message lists the names.
std::unique_ptr<Device> make_device(const std::string &name, std::uint64_t seed = 1);
} // namespace ode_predictive_space::haptics

#endif
