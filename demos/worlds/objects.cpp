#include "demos/worlds/objects.h"

#include "demos/worlds/pair_list.h"

#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr unsigned long scenery_category = 2;
} // namespace

bool turn_back(const Eigen::AlignedBox3d &room, const Vector3 &position, Vector3 &velocity)
{
    const auto leaves = (position.array() > room.max().array() && velocity.array() > 0) ||
                        (position.array() < room.min().array() && velocity.array() < 0);
    const bool turns = leaves.any();
    velocity = leaves.select(-velocity, velocity).eval();
    return turns;
}

void turn_back(const Eigen::AlignedBox3d &room, dBodyID body)
{
    Vector3 velocity = from_ode(dBodyGetLinearVel(body));
    if (turn_back(room, from_ode(dBodyGetPosition(body)), velocity))
        set_velocity(body, velocity);
}

Objects::~Objects()
{
    clear();
    dWorldDestroy(world_);
}

void Objects::clear()
{
    for (const dGeomID geom : geoms_)
    {
        if (geom != nullptr)
            dGeomDestroy(geom);
    }
    geoms_.clear();
}

dGeomID Objects::add_geom(dGeomID geom)
{
    set_geom_index(geom, static_cast<std::uint32_t>(geoms_.size()));
    geoms_.push_back(geom);
    return geom;
}

dGeomID Objects::add_scenery(dGeomID geom)
{
    dGeomSetCategoryBits(geom, scenery_category);
    dGeomSetCollideBits(geom, ~scenery_category);
    return add_geom(geom);
}

dGeomID Objects::make_geom(Shape shape)
{
    if (shape == Shape::mesh && ball_ == nullptr)
        ball_ = make_ball(object_radius);
    return add_geom(make_shape(space_, shape, object_radius, {ball_.get(), &octahedron_}));
}

Object Objects::add_still(Shape shape, const Vector3 &position, const Quaternion &orientation)
{
    const dGeomID geom = make_geom(shape);
    set_position(geom, position);
    set_orientation(geom, orientation);
    return {geom, nullptr, shape};
}

Object Objects::add_moving(Shape shape, const BodyState &state, double density)
{
    const dGeomID geom = make_geom(shape);
    const dBodyID body = dBodyCreate(world_);
    const dMass mass = mass_of_shape(shape, object_radius, density);
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    set_state(body, state);
    return {geom, body, shape};
}

dBodyID Objects::add_body(dGeomID geom, double mass, const BodyState &state)
{
    add_geom(geom);
    dReal box[6];
    dGeomGetAABB(geom, box);
    dMass inertia;
    dMassSetBoxTotal(&inertia, mass, box[1] - box[0], box[3] - box[2], box[5] - box[4]);
    const dBodyID body = dBodyCreate(world_);
    dBodySetMass(body, &inertia);
    dGeomSetBody(geom, body);
    set_state(body, state);
    return body;
}

void Objects::attach(dGeomID geom, dBodyID body, const Vector3 &offset)
{
    add_geom(geom);
    dGeomSetBody(geom, body);
    dGeomSetOffsetPosition(geom, offset.x(), offset.y(), offset.z());
}

void Objects::destroy(const Object &object)
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
    set_velocity(body, state.velocity);
    dBodySetAngularVel(body, state.angular_velocity.x(), state.angular_velocity.y(), state.angular_velocity.z());
}

double half_room(int objects, double volume_fraction)
{
    const double volume_of_one = 4.0 / 3.0 * pi * std::pow(object_radius, 3);
    return 0.5 * std::cbrt(objects * volume_of_one / volume_fraction);
}
} // namespace ode_predictive_space::worlds
