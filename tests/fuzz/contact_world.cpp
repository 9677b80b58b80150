#include "tests/fuzz/contact_world.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/kept_pose.h"

namespace ode_predictive_space
{
namespace
{
using Eigen::Vector3d;

dReal real(double value)
{
    return static_cast<dReal>(value);
}

Polyhedron strip()
{
    return {{{-1, -1, 0}, {-0.5, 1, 0.2}, {0, -1, 0}, {0.5, 1, 0.2}, {1, -1, 0}}, {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}}};
}

// ODE requires the origin within a convex. Meshes may be flat, and away from their position.
Polyhedron polyhedron_of(const Form &form)
{
    const bool mesh = form.type == dTriMeshClass;
    const std::array shapes{Polyhedron::cube(), Polyhedron::octahedron(), Polyhedron::tetrahedron(),
                            Polyhedron::square(), strip()};
    const auto choice = static_cast<std::size_t>(form.polyhedron) % (mesh ? shapes.size() : 3);
    const double aside = form.polyhedron % 7 == 0 ? 0 : mesh ? 0.5 : 0.05;
    return shapes[choice].changed(0.5 * form.sides, aside * form.sides);
}

Vector3d position_of(dGeomID geom)
{
    dVector3 position;
    dGeomCopyPosition(geom, position);
    return {position[0], position[1], position[2]};
}

void set_position(dGeomID geom, const Vector3d &at)
{
    dGeomSetPosition(geom, real(at[0]), real(at[1]), real(at[2]));
}

// ODE frees the lists of triangles that a mesh keeps when they are cleared, but not with the mesh: LeakSanitizer finds them.
void clear_kept_triangles(dGeomID geom)
{
    if (geom && dGeomGetClass(geom) == dTriMeshClass)
        dGeomTriMeshClearTCCache(geom);
}

bool has_body(int type)
{
    return type != dPlaneClass && type != dHeightfieldClass;
}
} // namespace

ContactWorld::ContactWorld(const Setting &setting, ContactTally &tally)
    : tally_(tally), setting_(setting), world_(dWorldCreate()), space_(dPredictiveSpaceCreate(nullptr))
{
    dRandSetSeed(0);
    dPredictiveSpaceSetProximity(space_, setting.proximity);
    for (int role : {dPredictiveRoleEnvironment, dPredictiveRoleInteractive})
        dPredictiveSpaceSetDeviation(space_, role, real(setting.deviation), 0, 0);
}

ContactWorld::~ContactWorld()
{
    for (const Slot &slot : slots_)
        clear_kept_triangles(slot.geom);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
}

ContactWorld::Slot *ContactWorld::find(int slot)
{
    Slot &found = slots_[static_cast<std::size_t>(slot)];
    return found.geom ? &found : nullptr;
}

dGeomID ContactWorld::create(Slot &slot)
{
    const Vector3d &sides = slot.form.sides;
    switch (slot.form.type)
    {
    case dSphereClass:
        return dCreateSphere(space_, real(sides[0]));
    case dBoxClass:
        return dCreateBox(space_, real(sides[0]), real(sides[1]), real(sides[2]));
    case dCapsuleClass:
        return dCreateCapsule(space_, real(sides[0]), real(sides[1]));
    case dCylinderClass:
        return dCreateCylinder(space_, real(sides[0]), real(sides[1]));
    case dPlaneClass:
        return dCreatePlane(space_, real(sides[0]), real(sides[1]), real(sides[2]), 0);
    case dRayClass:
        return dCreateRay(space_, real(sides[0]));
    case dConvexClass:
        slot.convex = &convexes_.emplace_back(polyhedron_of(slot.form));
        return slot.convex->create(space_);
    case dTriMeshClass:
        slot.mesh = &meshes_.emplace_back(polyhedron_of(slot.form), slot.form.single);
        return dCreateTriMesh(space_, slot.mesh->id(), nullptr, nullptr, nullptr);
    case dGeomTransformClass:
        return create_geom(GeomKind::transform, real(sides[0]), space_);
    default:
    {
        std::mt19937_64 random(static_cast<unsigned>(slot.form.polyhedron));
        // If it were repeated without end, cells of 0.1 mm below a geom of 100 m would exceed ODE's memory.
        return dCreateHeightfield(space_, hills_.emplace_back(random, sides[0], sides[1], false).id(), 1);
    }
    }
}

void ContactWorld::make(int slot, const Form &form)
{
    destroy(slot);
    Slot &made = slots_[static_cast<std::size_t>(slot)];
    made.form = form;
    made.geom = create(made);
    if (slot % 2 == 0) // with the shape test, their pairs with primitives are tested by shape
        dPredictiveSpaceSetGeomRole(space_, made.geom, dPredictiveRoleInteractive);
    if (form.type == dTriMeshClass && form.coherent)
        for (int type : {dSphereClass, dBoxClass, dCapsuleClass})
            dGeomTriMeshEnableTC(made.geom, type, 1);
    if (form.body && has_body(form.type))
    {
        const dBodyID body = dBodyCreate(world_);
        dBodySetGravityMode(body, 0);
        dGeomSetBody(made.geom, body);
    }
}

void ContactWorld::destroy(int slot)
{
    Slot *made = find(slot);
    if (!made)
        return;
    take_body(slot);
    clear_kept_triangles(made->geom);
    dGeomDestroy(made->geom);
    *made = Slot();
}

void ContactWorld::take_body(int slot)
{
    Slot *made = find(slot);
    const dBodyID body = made ? dGeomGetBody(made->geom) : nullptr;
    if (!body)
        return;
    dGeomSetBody(made->geom, nullptr);
    dBodyDestroy(body);
}

void ContactWorld::place(int slot, const Vector3d &at)
{
    Slot *placed = find(slot);
    if (!placed)
        return;
    if (placed->form.type != dPlaneClass)
        return set_position(placed->geom, at);
    dVector4 plane;
    dGeomPlaneGetParams(placed->geom, plane);
    dGeomPlaneSetParams(placed->geom, plane[0], plane[1], plane[2],
                        real(plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2]));
}

void ContactWorld::place_beside(int slot, int other, const Vector3d &direction, bool with_contact, double part)
{
    Slot *placed = find(slot), *still = find(other);
    if (!placed || !still || placed == still || !collidable(*placed, *still))
        return;
    const Vector3d from = still->form.type == dPlaneClass ? Vector3d::Zero() : position_of(still->geom);
    const double size = std::max(extent_of(slot), extent_of(other));
    double touching = 0, apart = 2 * size;
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i)
    {
        const double middle = 0.5 * (touching + apart);
        place(slot, from + middle * direction);
        (touch(*placed, *still) ? touching : apart) = middle;
    }
    place(slot, from + ((with_contact ? touching : apart) + part * size) * direction);
}

void ContactWorld::move(int slot, const Vector3d &by)
{
    if (const Slot *moved = find(slot); moved && moved->form.type != dPlaneClass)
        place(slot, position_of(moved->geom) + by);
}

void ContactWorld::turn(int slot, const Vector3d &axis, double angle)
{
    const Slot *turned = find(slot);
    if (!turned || turned->form.type == dPlaneClass)
        return;
    dQuaternion now, by, product;
    dGeomGetQuaternion(turned->geom, now);
    dQFromAxisAndAngle(by, real(axis[0]), real(axis[1]), real(axis[2]), real(angle));
    dQMultiply0(product, by, now);
    dGeomSetQuaternion(turned->geom, product);
}

namespace
{
// The quaternion of a body is normalised, but its matrix need not be a rotation. ODE requires independent first rows.
void set_matrix_of(dGeomID geom, const dQuaternion quaternion)
{
    dMatrix3 matrix;
    dRfromQ(matrix, quaternion);
    for (dReal &entry : matrix)
        entry = std::round(100 * entry) / 100;
    const Vector3d first(matrix[0], matrix[1], matrix[2]), second(matrix[4], matrix[5], matrix[6]);
    if (first.cross(second).norm() > 1e-3)
        dGeomSetRotation(geom, matrix);
}
} // namespace

void ContactWorld::set_quaternion(int slot, const Eigen::Vector4d &quaternion)
{
    const Slot *turned = find(slot);
    if (!turned || turned->form.type == dPlaneClass)
        return;
    const dQuaternion q{real(quaternion[0]), real(quaternion[1]), real(quaternion[2]), real(quaternion[3])};
    if (dGeomGetBody(turned->geom))
        return set_matrix_of(turned->geom, q);
    dGeomSetQuaternion(turned->geom, q);
}

void ContactWorld::set_offset(int slot, const Vector3d &offset)
{
    const Slot *set = find(slot);
    if (set && dGeomGetBody(set->geom))
        dGeomSetOffsetPosition(set->geom, real(offset[0]), real(offset[1]), real(offset[2]));
}

void ContactWorld::set_velocity(int slot, const Vector3d &linear, const Vector3d &angular)
{
    const Slot *set = find(slot);
    const dBodyID body = set ? dGeomGetBody(set->geom) : nullptr;
    if (!body)
        return;
    dBodySetLinearVel(body, real(linear[0]), real(linear[1]), real(linear[2]));
    dBodySetAngularVel(body, real(angular[0]), real(angular[1]), real(angular[2]));
}

void ContactWorld::give_data(Slot &slot)
{
    if (slot.form.type == dConvexClass)
    {
        slot.convex = &convexes_.emplace_back(polyhedron_of(slot.form));
        slot.convex->give_to(slot.geom);
        // ODE sends no notice of the new box, and the sphere test knows only the box.
        if (setting_.proximity == dPredictiveProximitySphere)
            dPredictiveSpaceGeomChanged(space_, slot.geom);
        return;
    }
    slot.mesh = &meshes_.emplace_back(polyhedron_of(slot.form), slot.form.single);
    dGeomTriMeshSetData(slot.geom, slot.mesh->id());
    dGeomTriMeshClearTCCache(slot.geom);
}

void ContactWorld::resize(int slot, const Vector3d &sides)
{
    Slot *resized = find(slot);
    if (!resized)
        return;
    const dGeomID geom = resized->geom;
    resized->form.sides = sides;
    switch (resized->form.type)
    {
    case dSphereClass:
        return dGeomSphereSetRadius(geom, real(sides[0]));
    case dBoxClass:
        return dGeomBoxSetLengths(geom, real(sides[0]), real(sides[1]), real(sides[2]));
    case dCapsuleClass:
        return dGeomCapsuleSetParams(geom, real(sides[0]), real(sides[1]));
    case dCylinderClass:
        return dGeomCylinderSetParams(geom, real(sides[0]), real(sides[1]));
    case dRayClass:
        return dGeomRaySetLength(geom, real(sides[0]));
    case dConvexClass:
    case dTriMeshClass:
        return give_data(*resized);
    default:
        return;
    }
}

void ContactWorld::change_in_place(int slot, const Vector3d &factors)
{
    Slot *changed = find(slot);
    if (!changed || !(changed->convex || changed->mesh))
        return;
    const Vector3d before = changed->form.sides;
    changed->form.sides = before.cwiseProduct(factors);
    // An update of corners leaves the box of a mesh as it was, and the sphere test knows only the box.
    if (changed->mesh && setting_.proximity == dPredictiveProximitySphere)
        return rebuild_in_place(slot, changed->form.polyhedron, changed->form.sides);
    if (changed->convex)
        changed->convex->change(polyhedron_of(changed->form));
    else
        changed->mesh->move_corners(0.5 * (changed->form.sides - before));
    dPredictiveSpaceGeomChanged(space_, changed->geom);
}

void ContactWorld::rebuild_in_place(int slot, int polyhedron, const Vector3d &sides)
{
    Slot *changed = find(slot);
    if (!changed || !changed->mesh)
        return;
    changed->form.polyhedron = polyhedron;
    changed->form.sides = sides;
    changed->mesh->rebuild(polyhedron_of(changed->form));
    dGeomTriMeshClearTCCache(changed->geom);
    dPredictiveSpaceGeomChanged(space_, changed->geom);
}

void ContactWorld::step(double seconds)
{
    dWorldQuickStep(world_, real(seconds));
}

double ContactWorld::radius_of(int slot) const
{
    const Slot &asked = slots_[static_cast<std::size_t>(slot)];
    return asked.geom && asked.form.type == dSphereClass ? double{dGeomSphereGetRadius(asked.geom)} : 0;
}

double ContactWorld::extent_of(int slot) const
{
    const Slot &asked = slots_[static_cast<std::size_t>(slot)];
    if (!asked.geom)
        return 0;
    dReal box[6];
    dGeomGetAABB(asked.geom, box);
    const double extent = Vector3d(box[1] - box[0], box[3] - box[2], box[5] - box[4]).norm();
    return std::isfinite(extent) ? extent : 0;
}

// ODE uses libccd for other pairs with convexes, and libccd does not end for some nearly flat shapes.
bool ContactWorld::collidable(const Slot &one, const Slot &other)
{
    const auto excluded = [](const Slot &first, const Slot &second) {
        const int type = second.form.type;
        return first.form.type == dConvexClass && type != dSphereClass && type != dPlaneClass && type != dRayClass;
    };
    return !excluded(one, other) && !excluded(other, one);
}

bool ContactWorld::touch(const Slot &one, const Slot &other) const
{
    return collidable(one, other) &&
           (contacts_between(one.geom, other.geom) > 0 || contacts_between(other.geom, one.geom) > 0);
}

bool ContactWorld::overlap(const Slot &one, const Slot &other) const
{
    dReal a[6], b[6];
    dGeomGetAABB(one.geom, a);
    dGeomGetAABB(other.geom, b);
    return !(a[0] > b[1] || a[1] < b[0] || a[2] > b[3] || a[3] < b[2] || a[4] > b[5] || a[5] < b[4]);
}

void ContactWorld::foretell(int slot, int other)
{
    const Slot *one = find(slot), *second = find(other);
    if (!one || !second || one == second)
        return;
    if (slot > other)
        std::swap(one, second);
    forecast_.slot = std::min(slot, other);
    forecast_.other = std::max(slot, other);
    forecast_.within = dPredictiveSpaceGetTimeOfProximity(space_, one->geom, second->geom, &forecast_.ticks) == 0;
    forecast_.made = tally_.ticks;
    forecast_.boxes = {resting_box(*one), resting_box(*second)};
}

// The forecast of a resting body stays in place.
std::optional<ContactWorld::Bounds> ContactWorld::resting_box(const Slot &slot)
{
    const dBodyID body = dGeomGetBody(slot.geom);
    const auto rests = [](const dReal *velocity) { return std::count(velocity, velocity + 3, dReal(0)) == 3; };
    if (!body || !rests(dBodyGetLinearVel(body)) || !rests(dBodyGetAngularVel(body)))
        return std::nullopt;
    std::array<dReal, 6> box;
    dGeomGetAABB(slot.geom, box.data());
    return box;
}

bool ContactWorld::stayed(const Slot &slot, const std::optional<Bounds> &box) const
{
    const std::optional<Bounds> now = resting_box(slot);
    for (std::size_t i = 0; i < 6; ++i)
        if (!box || !now || !(std::abs((*now)[i] - (*box)[i]) <= setting_.deviation))
            return false;
    return true;
}

std::string ContactWorld::broken_forecast(const Slots &pair)
{
    if (pair != Slots(forecast_.slot, forecast_.other) || !stayed(*find(pair.first), forecast_.boxes[0]) ||
        !stayed(*find(pair.second), forecast_.boxes[1]))
        return "";
    ++tally_.forecasts;
    const auto passed = static_cast<dReal>(tally_.ticks - forecast_.made);
    const bool too_early = forecast_.within ? passed <= forecast_.ticks : passed < forecast_.ticks;
    return too_early ? describe(pair, "touch before the predicted time") : "";
}

std::string ContactWorld::describe(const Slots &pair, const char *what) const
{
    std::ostringstream text;
    text << "tick " << tally_.ticks << ": slots " << pair.first << " and " << pair.second << " " << what;
    for (int number : {pair.first, pair.second})
    {
        const Slot &slot = slots_[static_cast<std::size_t>(number)];
        text << "; class " << slot.form.type << ", sides " << slot.form.sides.transpose();
        if (slot.convex || slot.mesh)
            text << ", polyhedron " << slot.form.polyhedron;
    }
    return text.str();
}

std::set<ContactWorld::Slots> ContactWorld::reported()
{
    std::set<std::pair<dGeomID, dGeomID>> called;
    dSpaceCollide(space_, &called, [](void *data, dGeomID one, dGeomID other) {
        static_cast<decltype(called) *>(data)->insert(std::minmax(one, other));
    });
    std::set<Slots> pairs;
    for (int i = 0; i < slot_count; ++i)
        for (int j = i + 1; j < slot_count; ++j)
            if (called.count(
                    std::minmax(slots_[static_cast<std::size_t>(i)].geom, slots_[static_cast<std::size_t>(j)].geom)))
                pairs.insert({i, j});
    return pairs;
}

std::string ContactWorld::check(const Slots &pair, bool was_reported)
{
    const Slot *one = find(pair.first), *other = find(pair.second);
    if (!one || !other || !overlap(*one, *other))
        return "";
    ++tally_.overlapping;
    tally_.left_out += !was_reported;
    if (!touch(*one, *other))
        return "";
    ++tally_.contacts;
    tally_.classes.insert(std::minmax(one->form.type, other->form.type));
    return was_reported ? broken_forecast(pair) : describe(pair, "touch without a callback");
}

std::string ContactWorld::tick()
{
    ++tally_.ticks;
    if (setting_.asks && find(0))
        dPredictiveSpaceGetEncounters(space_, find(0)->geom, nullptr, 0);
    const std::set<Slots> reported = this->reported();
    for (int i = 0; i < slot_count; ++i)
        for (int j = i + 1; j < slot_count; ++j)
            if (const std::string wrong = check({i, j}, reported.count({i, j}) > 0); !wrong.empty())
                return wrong;
    constexpr long validated = 8;
    if (tally_.ticks % validated == 0 && dPredictiveSpaceValidate(space_) == 0)
        return "the invariant does not hold: " + OdeMessages::text();
    return "";
}
} // namespace ode_predictive_space
