#include "demos/worlds/objects.h"

#include "demos/worlds/pair_list.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr unsigned long scenery_category = 2;

// A capsule is a cylinder with two half balls; with these two its ends lie on the sphere.
constexpr double capsule_radius = object_radius / 2;
constexpr double capsule_length = object_radius;

const double cylinder_radius = object_radius / std::sqrt(2.0);

/// Corner 2 * axis is on the negative side of the axis, the next one on the positive side. Face number f is on the positive side
/// of those axes whose bits are set in f.
dGeomID make_octahedron(dSpaceID space)
{
    constexpr dReal r = object_radius;
    static const dReal points[] = {-r, 0, 0, r, 0, 0, 0, -r, 0, 0, r, 0, 0, 0, -r, 0, 0, r};
    // For each face the number of its corners and the corners, counterclockwise as seen from outside.
    static const unsigned polygons[] = {3, 4, 2, 0, 3, 1, 2, 4, 3, 0, 3, 4, 3, 4, 3, 1,
                                        3, 0, 2, 5, 3, 5, 2, 1, 3, 5, 3, 0, 3, 1, 3, 5};
    // For each face its outward normal and its distance from the centre.
    static const std::array<dReal, 32> planes = [] {
        std::array<dReal, 32> result{};
        for (unsigned face = 0; face < 8; ++face)
        {
            for (unsigned axis = 0; axis < 3; ++axis)
                result[4 * face + axis] = ((face >> axis & 1u) == 0 ? -1 : 1) / std::sqrt(3.0);
            result[4 * face + 3] = r / std::sqrt(3.0);
        }
        return result;
    }();
    return dCreateConvex(space, planes.data(), 8, points, 6, polygons);
}
} // namespace

dGeomID make_shape(dSpaceID space, Shape shape, const TriangleMesh *ball)
{
    switch (shape)
    {
    case Shape::box:
        return dCreateBox(space, 2 * half_side_of_box(), 2 * half_side_of_box(), 2 * half_side_of_box());
    case Shape::capsule:
        return dCreateCapsule(space, capsule_radius, capsule_length);
    case Shape::mesh:
        return ball->make_geom(space);
    case Shape::cylinder:
        return dCreateCylinder(space, cylinder_radius, 2 * cylinder_radius);
    case Shape::convex:
        return make_octahedron(space);
    case Shape::sphere:
        break;
    }
    return dCreateSphere(space, object_radius);
}

dMass mass_of_shape(Shape shape, double density)
{
    dMass mass;
    switch (shape)
    {
    case Shape::box:
        dMassSetBox(&mass, density, 2 * half_side_of_box(), 2 * half_side_of_box(), 2 * half_side_of_box());
        break;
    case Shape::capsule:
        dMassSetCapsule(&mass, density, 3, capsule_radius, capsule_length);
        break;
    case Shape::cylinder:
        dMassSetCylinder(&mass, density, 3, cylinder_radius, 2 * cylinder_radius);
        break;
    case Shape::convex: // as that of a ball, its inertia is the same about all axes
        dMassSetSphereTotal(&mass, density * (4.0 / 3.0 * std::pow(object_radius, 3)), std::sqrt(0.5) * object_radius);
        break;
    case Shape::sphere:
    case Shape::mesh:
        dMassSetSphere(&mass, density, object_radius);
        break;
    }
    return mass;
}

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
    {
        ball_ = std::make_unique<TriangleMesh>();
        ball_->add_ball(object_radius);
        ball_->build(true);
    }
    return add_geom(make_shape(space_, shape, ball_.get()));
}

dGeomID Objects::add_still(Shape shape, const Vector3 &position, const Quaternion &orientation)
{
    const dGeomID geom = make_geom(shape);
    set_position(geom, position);
    set_orientation(geom, orientation);
    return geom;
}

dBodyID Objects::add_moving(Shape shape, const BodyState &state, double density)
{
    return add_body(make_geom(shape), mass_of_shape(shape, density), state);
}

dBodyID Objects::add_body(dGeomID geom, double mass, const BodyState &state)
{
    dReal box[6];
    dGeomGetAABB(add_geom(geom), box);
    dMass inertia;
    dMassSetBoxTotal(&inertia, mass, box[1] - box[0], box[3] - box[2], box[5] - box[4]);
    return add_body(geom, inertia, state);
}

dBodyID Objects::add_body(dGeomID geom, const dMass &mass, const BodyState &state)
{
    const dBodyID body = dBodyCreate(world_);
    dBodySetMass(body, &mass);
    dGeomSetBody(geom, body);
    set_state(body, state);
    bodies_.push_back(body);
    return body;
}

void Objects::attach(dGeomID geom, dBodyID body, const Vector3 &offset)
{
    add_geom(geom);
    dGeomSetBody(geom, body);
    dGeomSetOffsetPosition(geom, offset.x(), offset.y(), offset.z());
}

void Objects::destroy(dGeomID geom)
{
    geoms_[geom_index(geom)] = nullptr;
    const dBodyID body = dGeomGetBody(geom);
    dGeomDestroy(geom);
    if (body == nullptr)
        return;
    bodies_.erase(std::find(bodies_.begin(), bodies_.end(), body));
    dBodyDestroy(body);
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
