#include "tests/shape/shape_history.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <ode_predictive_space/predictive_space.h>

#include "tests/support/overlap.h"

namespace ode_predictive_space
{
namespace
{
constexpr dReal step = REAL(0.01);

// ODE reports an error for convexes on meshes without angles of faces, so these are not collided.
bool collidable(dGeomID one, dGeomID other)
{
    return std::max(dGeomGetClass(one), dGeomGetClass(other)) != dTriMeshClass ||
           std::min(dGeomGetClass(one), dGeomGetClass(other)) != dConvexClass;
}

bool touch(dGeomID one, dGeomID other)
{
    if (!collidable(one, other))
        return false;
    std::array<dContactGeom, 4> contacts;
    // A fixed order makes the results comparable.
    return dCollide(std::min(one, other), std::max(one, other), 4, contacts.data(), sizeof contacts[0]) > 0;
}

bool touch_within_box(dGeomID ray, dGeomID geom)
{
    dReal box[6];
    dGeomGetAABB(geom, box);
    dContactGeom contacts[8];
    const int count = dCollide(ray, geom, 8, contacts, sizeof(dContactGeom));
    return std::any_of(contacts, contacts + count, [&](const dContactGeom &contact) {
        const dReal *place = contact.pos;
        return place[0] >= box[0] && place[0] <= box[1] && place[1] >= box[2] && place[1] <= box[3] &&
               place[2] >= box[4] && place[2] <= box[5];
    });
}

void note_contact(void *data, dGeomID one, dGeomID other)
{
    auto &[collision, seen] = *static_cast<std::pair<ShapeHistory::Collision, ShapeHistory::GeomPairs> *>(data);
    const std::pair<dGeomID, dGeomID> pair = std::minmax(one, other);
    collision.repeated += !seen.insert(pair).second;
    ++collision.calls;
    if (touch(one, other))
        collision.contacts.insert(pair);
}
} // namespace

ShapeHistory::ShapeHistory(const Setting &setting)
    : setting_(setting), random_(setting.seed), world_(dWorldCreate()), space_(dPredictiveSpaceCreate(nullptr)),
      ball_(dCreateSphere(nullptr, REAL(0.3))), ray_(dCreateRay(nullptr, 1))
{
    dPredictiveSpaceSetProximity(space_, setting_.proximity);
    for (int role : {dPredictiveRoleEnvironment, dPredictiveRoleInteractive})
        dPredictiveSpaceSetDeviation(space_, role, static_cast<dReal>(setting_.deviation), 0, 0);
    for (int i = 0; i < 6; ++i)
    {
        meshes_.emplace_back(polyhedron(), i % 2 == 0);
        convexes_.emplace_back(polyhedron());
    }
    if (setting_.with_room)
        create_room();
    else if (setting_.with_hills)
        create_hills();
    else if (setting_.with_plane)
        members_.push_back(
            {dCreatePlane(space_, 0, 0, 1, static_cast<dReal>(-0.7 * setting_.half_room)), GeomKind::plane});
    while (static_cast<int>(members_.size()) < setting_.geoms)
        create();
}

ShapeHistory::~ShapeHistory()
{
    dGeomDestroy(ball_);
    dGeomDestroy(ray_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
}

Polyhedron ShapeHistory::polyhedron()
{
    const std::array shapes{Polyhedron::cube(), Polyhedron::octahedron(), Polyhedron::tetrahedron()};
    const Eigen::Vector3d sides(between(0.1, 0.5), between(0.1, 0.5), between(0.1, 0.5));
    return shapes[any(shapes.size())].changed(sides, 0.1 * sides);
}

void ShapeHistory::create_room()
{
    Polyhedron room = Polyhedron::cube().changed(Eigen::Vector3d::Constant(1.05 * setting_.half_room), {0, 0, 0});
    for (int i = 0; i < 6; ++i)
    {
        const double half = setting_.half_room;
        room.add(Polyhedron::cube().changed({0.1, between(0.1, 0.5), between(0.1, half)},
                                            {between(-half, half), between(-half, half), between(-half, half)}));
    }
    meshes_.emplace_back(room, any(2) == 0);
    members_.push_back({dCreateTriMesh(space_, meshes_.back().id(), nullptr, nullptr, nullptr), GeomKind::trimesh});
    if (any(2))
        give_body(members_.back().geom);
}

// The y axis of a heightfield is up. One that cannot be moved keeps this direction.
void ShapeHistory::create_hills()
{
    const double half = setting_.half_room;
    const Hills &hills = hills_.emplace_back(random_, between(1.5, 3) * half, between(0.2, 1) * half);
    const bool is_placeable = any(2) == 0;
    members_.push_back({dCreateHeightfield(space_, hills.id(), is_placeable),
                        is_placeable ? GeomKind::heightfield : GeomKind::endless_heightfield});
}

dGeomID ShapeHistory::create_geom(GeomKind kind)
{
    if (kind == GeomKind::trimesh)
        return dCreateTriMesh(space_, meshes_[any(meshes_.size())].id(), nullptr, nullptr, nullptr);
    if (kind == GeomKind::convex)
        return convexes_[any(convexes_.size())].create(space_);
    return ode_predictive_space::create_geom(kind, real(0.1, 0.8), space_);
}

void ShapeHistory::create()
{
    constexpr std::array simple{GeomKind::sphere, GeomKind::box, GeomKind::capsule, GeomKind::cylinder};
    constexpr std::array of_data{GeomKind::trimesh, GeomKind::convex};
    constexpr std::array others{GeomKind::ray, GeomKind::transform, GeomKind::heightfield};
    const std::size_t choice = setting_.all_classes ? any(8) : 0;
    const GeomKind kind = choice == 7   ? others[any(others.size())]
                          : choice >= 5 ? of_data[any(of_data.size())]
                                        : simple[any(simple.size() - !setting_.with_cylinders)];
    const dGeomID geom = create_geom(kind);
    members_.push_back({geom, kind});
    if (members_.size() % static_cast<std::size_t>(setting_.interactive) == 0)
        dPredictiveSpaceSetGeomRole(space_, geom, dPredictiveRoleInteractive);
    if (any(5) > 0 && kind != GeomKind::heightfield)
        give_body(geom);
    place(geom);
    turn(geom);
    if (any(4) == 0)
        offset(geom);
}

void ShapeHistory::give_body(dGeomID geom)
{
    const dBodyID body = dBodyCreate(world_);
    dBodySetGravityMode(body, 0);
    dGeomSetBody(geom, body);
    set_velocity(body);
}

void ShapeHistory::set_velocity(dBodyID body)
{
    const double speed = any(4) == 0 ? 0 : std::exp(between(-4, 1)),
                 spin = any(4) == 0 ? 0 : std::exp(between(-3, 2.5));
    dBodySetLinearVel(body, real(-speed, speed), real(-speed, speed), real(-speed, speed));
    dBodySetAngularVel(body, real(-spin, spin), real(-spin, spin), real(-spin, spin));
    dBodyEnable(body);
}

void ShapeHistory::place(dGeomID geom)
{
    const double half = setting_.half_room;
    dGeomSetPosition(geom, real(-half, half), real(-half, half), real(-half, half));
}

void ShapeHistory::turn(dGeomID geom)
{
    dMatrix3 turned;
    dRFromAxisAndAngle(turned, real(-1, 1), real(-1, 1), real(-1, 1), real(-4, 4));
    dGeomSetRotation(geom, turned);
}

void ShapeHistory::offset(dGeomID geom)
{
    if (dGeomGetBody(geom) == nullptr)
        return;
    dMatrix3 turned;
    dRFromAxisAndAngle(turned, real(-1, 1), real(-1, 1), real(-1, 1), real(-4, 4));
    dGeomSetOffsetPosition(geom, real(-0.5, 0.5), real(-0.5, 0.5), real(-0.5, 0.5));
    dGeomSetOffsetRotation(geom, turned);
}

void ShapeHistory::push(dGeomID geom)
{
    const dBodyID body = dGeomGetBody(geom);
    if (body == nullptr)
        return;
    dBodyEnable(body);
    dBodyAddForce(body, real(-50, 50), real(-50, 50), real(-50, 50));
    dBodyAddTorque(body, real(-50, 50), real(-50, 50), real(-50, 50));
}

void ShapeHistory::lose_body(dGeomID geom)
{
    const dBodyID body = dGeomGetBody(geom);
    if (body == nullptr)
    {
        give_body(geom);
        place(geom);
        return;
    }
    dGeomSetBody(geom, nullptr);
    dBodyDestroy(body);
}

void ShapeHistory::destroy(std::size_t index)
{
    const dGeomID geom = members_[index].geom;
    const dBodyID body = dGeomGetBody(geom);
    dGeomDestroy(geom);
    if (body)
        dBodyDestroy(body);
    members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(index));
}

void ShapeHistory::resize(std::size_t index)
{
    const Member &member = members_[index];
    switch (member.kind)
    {
    case GeomKind::sphere:
        dGeomSphereSetRadius(member.geom, real(0.05, 0.8));
        break;
    case GeomKind::box:
        dGeomBoxSetLengths(member.geom, real(0.05, 1.5), real(0.05, 1.5), real(0.05, 1.5));
        break;
    case GeomKind::capsule:
        dGeomCapsuleSetParams(member.geom, real(0.05, 0.5), real(0.05, 1.5));
        break;
    case GeomKind::cylinder:
        dGeomCylinderSetParams(member.geom, real(0.05, 0.8), real(0.05, 1.5));
        break;
    case GeomKind::plane:
        dGeomPlaneSetParams(member.geom, real(-0.2, 0.2), real(-0.2, 0.2), 1, real(-2, -0.5));
        break;
    case GeomKind::trimesh:
    case GeomKind::convex:
        give_other_data(member);
        break;
    case GeomKind::endless_heightfield:
        change_hills();
        break;
    default:
        resize_geom(member.geom, member.kind, any(2) ? REAL(0.3) : REAL(1.0));
    }
}

void ShapeHistory::give_other_data(const Member &member)
{
    if (member.kind == GeomKind::convex)
        convexes_[any(convexes_.size())].give_to(member.geom);
    else if (any(2))
        dGeomTriMeshSetData(member.geom, meshes_[any(meshes_.size())].id());
    else
        meshes_[any(meshes_.size())].rebuild(polyhedron());
}

void ShapeHistory::change_in_place()
{
    const Eigen::Vector3d by(between(-0.1, 0.1), between(-0.1, 0.1), between(-0.1, 0.1));
    meshes_[any(meshes_.size())].move_corners(by);
    for (const Member &member : members_)
        if (member.kind == GeomKind::trimesh)
            dPredictiveSpaceGeomChanged(space_, member.geom);
}

void ShapeHistory::change_hills()
{
    if (any(2))
        hills_.back().rebuild(random_);
    else
        hills_.back().change_in_place(random_);
    dPredictiveSpaceGeomChanged(space_, members_.front().geom);
}

void ShapeHistory::surprise()
{
    const std::size_t index = any(members_.size());
    if ((setting_.with_room || setting_.with_hills) && index == 0 && any(10) > 0)
        return; // a room lasts longer
    const dGeomID geom = members_[index].geom;
    const bool placeable = is_placeable(members_[index].kind);
    const dBodyID body = placeable ? dGeomGetBody(geom) : nullptr;
    const auto kind_of_surprise = any(14);
    if (kind_of_surprise == 0 || !placeable)
        resize(index);
    else if (kind_of_surprise == 1)
        place(geom);
    else if (kind_of_surprise == 2)
        turn(geom);
    else if (kind_of_surprise == 3)
        offset(geom);
    else if (kind_of_surprise == 4)
        (dGeomIsEnabled(geom) ? dGeomDisable : dGeomEnable)(geom);
    else if (kind_of_surprise == 5)
        destroy(index);
    else if (kind_of_surprise == 6 && members_[index].kind != GeomKind::heightfield)
        lose_body(geom);
    else if (kind_of_surprise == 7 && body)
        dBodyDisable(body);
    else if (kind_of_surprise == 8 && body)
        set_velocity(body);
    else if (kind_of_surprise == 9)
        create();
    else if (kind_of_surprise == 10)
        dGeomSetCategoryBits(geom, any(2) ? 1u : ~0u);
    else if (kind_of_surprise == 11)
        change_in_place();
    else
        push(geom);
    while (static_cast<int>(members_.size()) < setting_.geoms / 2)
        create();
}

void ShapeHistory::keep_inside()
{
    for (const Member &member : members_)
    {
        const dBodyID body = member.kind == GeomKind::plane ? nullptr : dGeomGetBody(member.geom);
        if (body == nullptr)
            continue;
        const dReal *position = dBodyGetPosition(body), *velocity = dBodyGetLinearVel(body);
        dReal turned[3];
        bool turns = false;
        for (int axis = 0; axis < 3; ++axis)
        {
            const bool leaves = std::abs(position[axis]) > setting_.half_room && position[axis] * velocity[axis] > 0;
            turned[axis] = leaves ? -velocity[axis] : velocity[axis];
            turns |= leaves;
        }
        if (turns)
            dBodySetLinearVel(body, turned[0], turned[1], turned[2]);
    }
}

void ShapeHistory::advance()
{
    for (double left = setting_.surprises; left > 0; --left)
        if (between(0, 1) < left)
            surprise();
    keep_inside();
    if (any(20) > 0)
        dWorldQuickStep(world_, step);
}

ShapeHistory::Collision ShapeHistory::collide()
{
    std::pair<Collision, GeomPairs> collected;
    dSpaceCollide(space_, &collected, note_contact);
    return collected.first;
}

void ShapeHistory::compare(dGeomID one, dGeomID other, Truth &truth)
{
    if (!dGeomIsEnabled(one) || !may_collide(one, other) || !boxes_overlap(one, other))
        return;
    ++truth.overlapping;
    if (touch(one, other))
        truth.contacts.insert(std::minmax(one, other));
}

ShapeHistory::Truth ShapeHistory::brute_force() const
{
    Truth truth;
    for (std::size_t i = 0; i < members_.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (dGeomIsEnabled(members_[j].geom))
                compare(members_[i].geom, members_[j].geom, truth);
    return truth;
}

ShapeHistory::Collision ShapeHistory::ask(dGeomID probe)
{
    std::pair<Collision, GeomPairs> collected;
    dSpaceCollide2(probe, reinterpret_cast<dGeomID>(space_), &collected, note_contact);
    return collected.first;
}

// A mesh whose corners were changed in place keeps its old box: contacts of a ray outside this box do not count.
ShapeHistory::Truth ShapeHistory::brute_force(dGeomID probe) const
{
    Truth truth;
    for (const Member &member : members_)
        if (dGeomGetClass(probe) != dRayClass || member.kind != GeomKind::trimesh ||
            touch_within_box(probe, member.geom))
            compare(member.geom, probe, truth);
    return truth;
}

std::vector<dGeomID> ShapeHistory::probes()
{
    const double half = setting_.half_room;
    dGeomSetPosition(ball_, real(-half, half), real(-half, half), real(-half, half));
    dGeomRaySetLength(ray_, real(0, 2 * half));
    dGeomRaySet(ray_, real(-half, half), real(-half, half), real(-half, half), real(-1, 1), real(-1, 1), real(-1, 1));
    return {ball_, ray_, members_[any(members_.size())].geom};
}
} // namespace ode_predictive_space
