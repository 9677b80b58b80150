#include "ode_predictive_space/recording/state.h"

#include <algorithm>
#include <cstring>

#include <ode/matrix.h>
#include <ode/odemath.h>

#include "ode_predictive_space/ode/internals.h"
#include "ode_predictive_space/recording/format.h"

namespace ode_predictive_space::recording
{
namespace
{
Pose pose_of(const dReal *position, const dReal *rotation)
{
    Pose pose;
    std::copy_n(position, 3, pose.begin());
    for (std::size_t row = 0; row < 3; ++row)
        std::copy_n(rotation + 4 * row, 3, pose.begin() + 3 + 3 * static_cast<std::ptrdiff_t>(row));
    return pose;
}

void read_size(dGeomID geom, GeomState &state)
{
    dReal *size = state.size.data();
    switch (state.geom_class)
    {
    case dSphereClass:
        size[0] = dGeomSphereGetRadius(geom);
        break;
    case dBoxClass:
        std::copy_n(static_cast<const dxBox *>(geom)->side, 3, size);
        break;
    case dCapsuleClass:
        dGeomCapsuleGetParams(geom, &size[0], &size[1]);
        break;
    case dCylinderClass:
        dGeomCylinderGetParams(geom, &size[0], &size[1]);
        break;
    case dPlaneClass:
        dGeomPlaneGetParams(geom, size);
        break;
    case dRayClass:
        size[0] = dGeomRayGetLength(geom);
        break;
    case stand_in:
        dGeomGetAABB(geom, size);
        break;
    default:
        break;
    }
}

std::uint8_t flags_of(dGeomID geom, dGeomID shape)
{
    int flags = dGeomIsEnabled(geom) ? geom_enabled : 0;
    if (shape->type != dRayClass)
        return static_cast<std::uint8_t>(flags);
    flags |= (dGeomRayGetFirstContact(shape) ? ray_first_contact : 0) |
             (dGeomRayGetBackfaceCull(shape) ? ray_backface_cull : 0) |
             (dGeomRayGetClosestHit(shape) ? ray_closest_hit : 0);
    return static_cast<std::uint8_t>(flags);
}

std::uint8_t class_of(dGeomID shape)
{
    if (shape->type == dGeomTransformClass || shape->type > dLastSpaceClass)
        return stand_in;
    if (shape->type == dHeightfieldClass && !(shape->gflags & GEOM_PLACEABLE))
        return fixed_heightfield;
    return static_cast<std::uint8_t>(shape->type);
}

// Computes the pose of the geom inside a transform as ODE does, to the bit.
dxPosR held_at(const dReal *position, const dReal *rotation, dGeomID held)
{
    dxPosR place{};
    dMultiply0_331(place.pos, rotation, dGeomGetPosition(held));
    dAddVectors3(place.pos, place.pos, position);
    dMultiply0_333(place.R, rotation, dGeomGetRotation(held));
    return place;
}

Pose pose_of(dGeomID geom, dGeomID shape)
{
    if (shape == geom)
        return pose_of(dGeomGetPosition(geom), dGeomGetRotation(geom));
    const dxPosR place = held_at(dGeomGetPosition(geom), dGeomGetRotation(geom), shape);
    return pose_of(place.pos, place.R);
}

Pose offset_of(dGeomID geom, dGeomID shape)
{
    if (shape == geom)
        return pose_of(dGeomGetOffsetPosition(geom), dGeomGetOffsetRotation(geom));
    const dxPosR place = held_at(dGeomGetOffsetPosition(geom), dGeomGetOffsetRotation(geom), shape);
    return pose_of(place.pos, place.R);
}

void read_space(dSpaceID space, SpaceState &state)
{
    state.sublevel = space->sublevel;
    if (space->type == dHashSpaceClass)
        dHashSpaceGetLevels(space, &state.min_level, &state.max_level);
}

template <typename Value> bool differ(const Value &before, const Value &now)
{
    return std::memcmp(&before, &now, sizeof now) != 0;
}

std::uint16_t when(bool differs, std::uint16_t field)
{
    return differs ? field : std::uint16_t{0};
}
} // namespace

bool has_own_pose(const GeomState &state)
{
    return is_placeable_class(state.geom_class) && (state.body == 0 || state.has_offset);
}

BodyState state_of(dBodyID body)
{
    BodyState state;
    state.flags = static_cast<std::uint8_t>((dBodyIsEnabled(body) ? body_enabled : 0) |
                                            (dBodyIsKinematic(body) ? body_kinematic : 0));
    state.pose = pose_of(dBodyGetPosition(body), dBodyGetRotation(body));
    std::copy_n(dBodyGetLinearVel(body), 3, state.velocity.begin());
    std::copy_n(dBodyGetAngularVel(body), 3, state.velocity.begin() + 3);
    return state;
}

// ODE's own header calls transforms deprecated; programs have them.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
dGeomID shape_of(dGeomID geom)
{
    const dGeomID held = geom->type == dGeomTransformClass ? dGeomTransformGetGeom(geom) : nullptr;
    // ODE collides a transform also when the geom inside has no size.
    const bool can_be_recorded = held && held->type <= dTriMeshClass && held->type != dGeomTransformClass &&
                                 (held->gflags & (GEOM_PLACEABLE | GEOM_ZERO_SIZED)) == GEOM_PLACEABLE;
    return can_be_recorded ? held : geom;
}
#pragma GCC diagnostic pop

GeomState state_of(dGeomID geom)
{
    const dGeomID shape = shape_of(geom);
    GeomState state;
    state.geom_class = class_of(shape);
    state.flags = flags_of(geom, shape);
    state.bits = {geom->category_bits, geom->collide_bits};
    read_size(shape, state);
    if (IS_SPACE(geom))
        read_space(static_cast<dSpaceID>(geom), state.space);
    if (!is_placeable_class(state.geom_class))
        return state;
    state.has_offset = geom->body && (shape != geom || dGeomIsOffset(geom));
    if (state.has_offset)
        state.offset = offset_of(geom, shape);
    if (!geom->body || state.has_offset)
        state.pose = pose_of(geom, shape);
    return state;
}

void make_stand_in(dGeomID geom, GeomState &state)
{
    state.geom_class = stand_in;
    state.has_offset = 0;
    state.offset = state.pose = Pose{};
    read_size(geom, state);
}

std::uint16_t difference(const BodyState &before, const BodyState &now)
{
    return static_cast<std::uint16_t>(when(before.flags != now.flags, body_field::flags) |
                                      when(differ(before.pose, now.pose), body_field::pose) |
                                      when(differ(before.velocity, now.velocity), body_field::velocity));
}

std::uint16_t difference(const GeomState &before, const GeomState &now)
{
    const bool other_offset = before.has_offset != now.has_offset || differ(before.offset, now.offset);
    // The pose of a geom that leaves its body, or gets an offset from it, is new.
    const bool other_pose = has_own_pose(now) && (!has_own_pose(before) || differ(before.pose, now.pose));
    return static_cast<std::uint16_t>(
        when(before.geom_class != now.geom_class, geom_field::is_new) |
        when(differ(before.space, now.space), geom_field::space) |
        when(differ(before.service, now.service), geom_field::service) |
        when(before.parent != now.parent, geom_field::parent) | when(before.bits != now.bits, geom_field::bits) |
        when(before.flags != now.flags, geom_field::flags) | when(differ(before.size, now.size), geom_field::size) |
        when(before.data != now.data, geom_field::data) | when(before.body != now.body, geom_field::body) |
        when(other_offset, geom_field::offset) | when(other_pose, geom_field::pose));
}
} // namespace ode_predictive_space::recording
