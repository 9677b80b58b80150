#include "ode_predictive_space/haptics/contact/mobility.h"

#include <ode/objects.h>

namespace ode_predictive_space::haptics
{
Mobility Mobility::of(dBodyID body)
{
    Mobility mobility;
    if (body == nullptr || dBodyIsKinematic(body) != 0)
        return mobility;
    dMass mass;
    dBodyGetMass(body, &mass);
    const dReal *turn = dBodyGetRotation(body);
    Eigen::Matrix3d rotation, inertia;
    for (int row = 0; row < 3; ++row)
    {
        for (int column = 0; column < 3; ++column)
        {
            rotation(row, column) = static_cast<double>(turn[4 * row + column]);
            inertia(row, column) = static_cast<double>(mass.I[4 * row + column]);
        }
    }
    mobility.inverse_mass = 1 / static_cast<double>(mass.mass);
    mobility.inverse_inertia = rotation * inertia.inverse() * rotation.transpose();
    return mobility;
}
} // namespace ode_predictive_space::haptics
