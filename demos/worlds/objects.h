// The parts of all worlds: solids, each as large as a sphere of object_radius allows, and other geoms, with or without a body.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_OBJECTS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_OBJECTS_H

#include "demos/worlds/surfaces.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace ode_predictive_space::worlds
{
/// Radius of the sphere around an object, metres.
constexpr double object_radius = 0.1;

enum class Shape
{
    sphere,
    box,
    capsule,
    mesh,     ///< a faceted ball of 80 triangles
    cylinder, ///< as long as it is wide
    convex    ///< an octahedron
};

/// Half the side of a cube, as all boxes here are, in metres.
inline double half_side_of_box()
{
    return object_radius / std::sqrt(3.0);
}

/// @param ball for Shape::mesh: see TriangleMesh::add_ball().
dGeomID make_shape(dSpaceID space, Shape shape, const TriangleMesh *ball = nullptr);

/// The mass of such a solid. A mesh has the mass of the ball that it represents.
dMass mass_of_shape(Shape shape, double density);

/// The step of worlds that have no rate of their own, in seconds.
constexpr double usual_tick = 0.001;

struct BodyState
{
    Vector3 position = Vector3::Zero();
    Quaternion orientation = Quaternion::Identity();
    Vector3 velocity = Vector3::Zero();         ///< m/s
    Vector3 angular_velocity = Vector3::Zero(); ///< rad/s
};

/// Owns ODE's world, the bodies and the geoms of one world; numbers the geoms in the order of creation, from 0 on.
class Objects
{
public:
    explicit Objects(dSpaceID space) : space_(space), world_(dWorldCreate()) {}
    ~Objects();
    Objects(const Objects &) = delete;
    Objects &operator=(const Objects &) = delete;

    dSpaceID space() const { return space_; }
    dWorldID world() const { return world_; }

    /// Take over a geom without a body (a wall, a probe).
    dGeomID add_geom(dGeomID geom);

    /// Take over a geom that does not collide with others of its kind: ground, shelves, trees.
    dGeomID add_scenery(dGeomID geom);

    dGeomID add_still(Shape shape, const Vector3 &position, const Quaternion &orientation);

    /// @param density kg/m^3
    dBodyID add_moving(Shape shape, const BodyState &state, double density);

    /// Take over a geom and give it a new body of this mass, in kg, with the inertia of the geom's box.
    dBodyID add_body(dGeomID geom, double mass, const BodyState &state);

    void attach(dGeomID geom, dBodyID body, const Vector3 &offset);

    /// Destroys a geom and its body, if it has one. Its number is not reused.
    void destroy(dGeomID geom);

    void clear();

    dGeomID geom(std::uint32_t index) const { return geoms_[index]; }

    /// All geoms by number; null for destroyed ones.
    const std::vector<dGeomID> &geoms() const { return geoms_; }

    /// The bodies of add_moving() and add_body(), in this order.
    const std::vector<dBodyID> &bodies() const { return bodies_; }

private:
    dGeomID make_geom(Shape shape);
    dBodyID add_body(dGeomID geom, const dMass &mass, const BodyState &state);

    dSpaceID space_;
    dWorldID world_;
    std::unique_ptr<TriangleMesh> ball_; ///< created with the first mesh
    std::vector<dGeomID> geoms_;         ///< by number
    std::vector<dBodyID> bodies_;
};

inline double mass_of(dBodyID body)
{
    dMass mass;
    dBodyGetMass(body, &mass);
    return mass.mass;
}

BodyState state_of(dBodyID body);
void set_state(dBodyID body, const BodyState &state);

/// Half the side of a cube in which n usual objects fill this share of the volume, in metres.
double half_room(int objects, double volume_fraction);
} // namespace ode_predictive_space::worlds

#endif
