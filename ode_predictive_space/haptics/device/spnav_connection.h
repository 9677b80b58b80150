// The connection to spacenavd, the server of 3D mice, through libspnav.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_SPNAV_CONNECTION_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_SPNAV_CONNECTION_H

#include "ode_predictive_space/haptics/device.h"
#include "ode_predictive_space/haptics/device/at_end.h"

#include <string>

namespace ode_predictive_space::haptics
{
/// The input of a mouse in the server's counts, in the library's frame: y up, z towards the person.
struct SpnavInput
{
    Vector3 translation = Vector3::Zero();
    Vector3 rotation = Vector3::Zero(); ///< rotation vector
    std::uint32_t buttons = 0;
};

class SpnavConnection
{
public:
    /// Waits for the server's answers for at most a second. @throws DeviceError as SpacenavDevice::open() does.
    SpnavConnection();

    const std::string &mouse() const { return mouse_; }

    /// @throws DeviceError lost, for a lost server or an unplugged mouse.
    void receive(SpnavInput &input);

private:
    AtEnd opened_;
    std::string mouse_;
};

} // namespace ode_predictive_space::haptics

#endif
