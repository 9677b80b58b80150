#include "demos/scenes/scene_objects.h"

#include <cmath>

namespace ode_predictive_space::scenes
{
SceneObjects::SceneObjects(dSpaceID space) : space_(space), world_(dWorldCreate()) {}

SceneObjects::~SceneObjects()
{
    for (dGeomID geom : geoms_)
    {
        if (geom != nullptr)
            dGeomDestroy(geom);
    }
    dWorldDestroy(world_);
}

dGeomID SceneObjects::add_geom(dGeomID geom)
{
    set_geom_index(geom, static_cast<std::uint32_t>(geoms_.size()));
    geoms_.push_back(geom);
    return geom;
}

dGeomID SceneObjects::make_geom(Shape shape)
{
    if (shape == Shape::mesh && mesh_ == nullptr)
        mesh_ = std::make_unique<BallMesh>(object_radius);
    return add_geom(make_shape(space_, shape, object_radius, {mesh_.get(), &octahedron_}));
}

Object SceneObjects::add_still(Shape shape, const Vector3 &position, const Quaternion &orientation)
{
    const dGeomID geom = make_geom(shape);
    set_position(geom, position);
    set_orientation(geom, orientation);
    return {geom, nullptr, shape};
}

Object SceneObjects::add_moving(Shape shape, const BodyState &state, double density)
{
    const dGeomID geom = make_geom(shape);
    const dBodyID body = dBodyCreate(world_);
    const dMass mass = mass_of_shape(shape, object_radius, density);
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    set_state(body, state);
    return {geom, body, shape};
}

void SceneObjects::destroy(const Object &object)
{
    geoms_[geom_index(object.geom)] = nullptr;
    dGeomDestroy(object.geom);
    if (object.body != nullptr)
        dBodyDestroy(object.body);
}

BodyState state_of(dBodyID body)
{
    const dReal *q = dBodyGetQuaternion(body);
    return {from_ode(dBodyGetPosition(body)), Quaternion(q[0], q[1], q[2], q[3]), from_ode(dBodyGetLinearVel(body)),
            from_ode(dBodyGetAngularVel(body))};
}

void set_state(dBodyID body, const BodyState &state)
{
    set_position(body, state.position);
    set_orientation(body, state.orientation);
    dBodySetLinearVel(body, state.velocity.x(), state.velocity.y(), state.velocity.z());
    dBodySetAngularVel(body, state.angular_velocity.x(), state.angular_velocity.y(), state.angular_velocity.z());
}

double half_room(int objects, double volume_fraction)
{
    const double volume_of_one = 4.0 / 3.0 * pi * std::pow(object_radius, 3);
    return 0.5 * std::cbrt(objects * volume_of_one / volume_fraction);
}
} // namespace ode_predictive_space::scenes
