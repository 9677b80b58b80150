// Vectors and rotations of the scenes, and their conversion to and from ODE.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_VECTOR_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_VECTOR_H

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <ode/ode.h>

namespace ode_predictive_space::scenes
{
using Vector3 = Eigen::Vector3d;
using Quaternion = Eigen::Quaterniond;

constexpr double pi = 3.14159265358979323846;

inline Vector3 from_ode(const dReal *v)
{
    return {v[0], v[1], v[2]};
}

inline void set_position(dBodyID body, const Vector3 &p)
{
    dBodySetPosition(body, p.x(), p.y(), p.z());
}

inline void set_position(dGeomID geom, const Vector3 &p)
{
    dGeomSetPosition(geom, p.x(), p.y(), p.z());
}

inline void set_orientation(dBodyID body, const Quaternion &q)
{
    const dQuaternion ode = {q.w(), q.x(), q.y(), q.z()};
    dBodySetQuaternion(body, ode);
}

inline void set_orientation(dGeomID geom, const Quaternion &q)
{
    const dQuaternion ode = {q.w(), q.x(), q.y(), q.z()};
    dGeomSetQuaternion(geom, ode);
}
} // namespace ode_predictive_space::scenes

#endif
