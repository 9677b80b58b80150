// The parts of all worlds: geoms, with or without a body.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_OBJECTS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_OBJECTS_H

#include "demos/worlds/shapes.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ode_predictive_space::worlds
{
/// Radius of the sphere around a usual object, metres.
constexpr double object_radius = 0.1;

/// Of worlds that do not step at a rate of their own, seconds.
constexpr double usual_tick = 0.001;

struct BodyState
{
    Vector3 position = Vector3::Zero();
    Quaternion orientation = Quaternion::Identity();
    Vector3 velocity = Vector3::Zero();         ///< m/s
    Vector3 angular_velocity = Vector3::Zero(); ///< rad/s
};

struct Object
{
    dGeomID geom = nullptr;
    dBodyID body = nullptr; ///< null for an object that never moves
    Shape shape = Shape::sphere;
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

    /// The same for one that does not collide with others of its kind: ground, shelves, trees.
    dGeomID add_scenery(dGeomID geom);

    /// Make an object of the usual size that never moves: no body.
    Object add_still(Shape shape, const Vector3 &position, const Quaternion &orientation);

    /// Make an object of the usual size with a body of its own.
    ///
    /// @param density kg/m^3
    Object add_moving(Shape shape, const BodyState &state, double density);

    /// Take over a geom and give it a new body of this mass, in kg, with the inertia of the geom's box.
    dBodyID add_body(dGeomID geom, double mass, const BodyState &state);

    /// Take over a further geom of a body, at a place relative to it.
    void attach(dGeomID geom, dBodyID body, const Vector3 &offset);

    /// Destroy an object. Its number is not reused.
    void destroy(const Object &object);

    /// Destroy all geoms.
    void clear();

    /// The geom of this number; null when it has been destroyed.
    dGeomID geom(std::uint32_t index) const { return geoms_[index]; }

    /// All of them, by number; null where one has been destroyed.
    const std::vector<dGeomID> &geoms() const { return geoms_; }

private:
    dGeomID make_geom(Shape shape);

    dSpaceID space_;
    dWorldID world_;
    std::unique_ptr<TriangleMesh> ball_; ///< created with the first mesh
    const Octahedron octahedron_{object_radius};
    std::vector<dGeomID> geoms_; ///< by number
};

BodyState state_of(dBodyID body);
void set_state(dBodyID body, const BodyState &state);

/// Half the side of a cube in which n usual objects fill this share of the volume, in metres.
double half_room(int objects, double volume_fraction);
} // namespace ode_predictive_space::worlds

#endif
