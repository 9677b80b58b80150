// The connection to spacenavd, the server of 3D mice, through libspnav.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_SPNAV_CONNECTION_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_SPNAV_CONNECTION_H

#include "ode_predictive_space/haptics/device.h"

#include <memory>
#include <string>

namespace ode_predictive_space::haptics
{
/// What a mouse tells, in the server's counts, but in our frame: y up, z towards the person.
struct SpnavInput
{
    Vector3 translation = Vector3::Zero();
    Vector3 rotation = Vector3::Zero(); ///< about an axis along it
    std::uint32_t buttons = 0;
};

class SpnavConnection
{
public:
    virtual ~SpnavConnection() = default;

    /// The mouse's name, for people.
    virtual std::string mouse() const = 0;

    /// Takes what the server has sent since the last call, without waiting for more.
    ///
    /// @throws DeviceError lost, when the server is gone or a mouse unplugged.
    virtual void receive(SpnavInput &input) = 0;
};

/// Waits for the server's answers, for a second at most.
///
/// @throws DeviceError as SpacenavDevice::open() does.
std::unique_ptr<SpnavConnection> connect_to_spacenavd();
} // namespace ode_predictive_space::haptics

#endif
