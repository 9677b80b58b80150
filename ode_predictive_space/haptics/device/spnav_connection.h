// The connection to spacenavd, the server of 3D mice, through libspnav.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_SPNAV_CONNECTION_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_SPNAV_CONNECTION_H

#include "ode_predictive_space/haptics/device.h"
#include "ode_predictive_space/haptics/device/at_end.h"

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

/// libspnav's one connection, from its opening to its closing.
class SpnavConnection
{
public:
    /// Waits for the server's answers, for a second at most.
    ///
    /// @throws DeviceError as SpacenavDevice::open() does.
    SpnavConnection();

    /// The mouse's name, for people.
    const std::string &mouse() const { return mouse_; }

    /// Takes what the server has sent since the last call, without waiting for more.
    ///
    /// @throws DeviceError lost, when the server is gone or a mouse unplugged.
    void receive(SpnavInput &input);

private:
    AtEnd opened_;
    std::string mouse_;
};

} // namespace ode_predictive_space::haptics

#endif
