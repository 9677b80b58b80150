#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_VECTOR_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_VECTOR_H

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <ode/ode.h>

namespace ode_predictive_space::worlds
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

inline void set_velocity(dBodyID body, const Vector3 &v)
{
    dBodySetLinearVel(body, v.x(), v.y(), v.z());
}

inline void add_force(dBodyID body, const Vector3 &f)
{
    dBodyAddForce(body, f.x(), f.y(), f.z());
}

/// Turns the velocity of an object back that leaves a room. @return whether the velocity was changed.
bool turn_back(const Eigen::AlignedBox3d &room, const Vector3 &position, Vector3 &velocity);

void turn_back(const Eigen::AlignedBox3d &room, dBodyID body);

inline Eigen::AlignedBox3d room_of(const Vector3 &half)
{
    return {-half, half};
}
} // namespace ode_predictive_space::worlds

#endif
