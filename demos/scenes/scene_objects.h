// The parts of all scenes: a world, and objects with or without a body.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_SCENE_OBJECTS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_SCENE_OBJECTS_H

#include "demos/scenes/scene.h"
#include "demos/scenes/shapes.h"
#include "ode_predictive_space/haptics/device/random.h"

#include <memory>
#include <vector>

namespace ode_predictive_space::scenes
{
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

/// Owns the world, bodies and geoms of one scene; numbers the geoms in the order of creation, from 0 on.
class SceneObjects
{
public:
    explicit SceneObjects(dSpaceID space);
    ~SceneObjects();
    SceneObjects(const SceneObjects &) = delete;
    SceneObjects &operator=(const SceneObjects &) = delete;

    dWorldID world() const { return world_; }

    /// Take over a geom without a body (a wall, a probe).
    dGeomID add_geom(dGeomID geom);

    /// Make an object that never moves: no body.
    Object add_still(Shape shape, const Vector3 &position, const Quaternion &orientation);

    /// Make an object with a body of its own.
    ///
    /// @param density kg/m^3
    Object add_moving(Shape shape, const BodyState &state, double density);

    /// Destroy an object. Its number is not reused.
    void destroy(const Object &object);

    /// The geom of this number; null when it has been destroyed.
    dGeomID geom(std::uint32_t index) const { return geoms_[index]; }

    /// All of them, by number; null where one has been destroyed.
    const std::vector<dGeomID> &geoms() const { return geoms_; }

    dSpaceID space() const { return space_; }

private:
    dGeomID make_geom(Shape shape);

    dSpaceID space_;
    dWorldID world_;
    std::unique_ptr<BallMesh> mesh_; ///< created with the first mesh
    const Octahedron octahedron_{object_radius};
    std::vector<dGeomID> geoms_; ///< by number
};

BodyState state_of(dBodyID body);
void set_state(dBodyID body, const BodyState &state);

/// Half the side of a cube in which n spheres of object_radius fill this share of the volume, in metres.
double half_room(int objects, double volume_fraction);
} // namespace ode_predictive_space::scenes

#endif
