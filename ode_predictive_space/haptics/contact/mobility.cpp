#include "ode_predictive_space/haptics/contact/mobility.h"

#include "ode_predictive_space/haptics/contact/ode_vector.h"

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
    using Rows = Eigen::Matrix<dReal, 3, 4, Eigen::RowMajor>;
    const Eigen::Matrix3d rotation = Eigen::Map<const Rows>(dBodyGetRotation(body)).leftCols<3>().cast<double>();
    mobility.inverse_mass = 1 / static_cast<double>(mass.mass);
    mobility.inverse_inertia = rotation * inertia_of(mass).inverse() * rotation.transpose();
    return mobility;
}
} // namespace ode_predictive_space::haptics
