#include "tests/differential/universe.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space
{
namespace
{
template <typename Slot> Slot &slot_at(std::vector<Slot> &slots, int index)
{
    if (static_cast<std::size_t>(index) >= slots.size())
        slots.resize(static_cast<std::size_t>(index) + 1);
    return slots[static_cast<std::size_t>(index)];
}

template <typename Slot> bool has_slot(const std::vector<Slot> &slots, int index)
{
    return index >= 0 && static_cast<std::size_t>(index) < slots.size();
}

void rotation_of(const Operation &operation, dMatrix3 rotation)
{
    dRFromAxisAndAngle(rotation, operation.value[0], operation.value[1], operation.value[2], operation.value[3]);
}

// Rows stay independent, as dBodySetRotation() requires.
void distorted_rotation_of(const Operation &operation, dMatrix3 matrix)
{
    rotation_of(operation, matrix);
    const int row = 4 * (operation.number / 4 % 3), column = operation.number / 12 % 3;
    switch (operation.number % 4)
    {
    case 0: // it is hardly distorted, only rounded to two digits
        break;
    case 1:
        for (int i = 0; i < 3; ++i)
            matrix[row + i] *= 1.5;
        break;
    case 2:
        matrix[row + column] += 0.4;
        break;
    default:
        for (int i = 0; i < 12; i += 4)
            matrix[i + column] *= 0.6;
    }
    for (int i = 0; i < 12; ++i)
        matrix[i] = std::round(100 * matrix[i]) / 100;
}

// For a ray without an offset, ODE moves the body and changes its matrix without a notice to the body's other geoms;
// dBodySetPosition() sends one.
void aim_ray(dGeomID ray, const Operation &operation)
{
    const auto &from = operation.value;
    const int number = operation.number;
    dGeomRaySet(ray, from[0], from[1], from[2], number % 5 - 2, number / 5 % 5 - 2, number / 25 % 5 - 2.5);
    if (const dBodyID body = dGeomGetBody(ray); body && !dGeomIsOffset(ray))
        dBodySetPosition(body, from[0], from[1], from[2]);
}

bool is_within(dSpaceID space, dGeomID maybe_ancestor)
{
    for (dGeomID each = as_geom(space); each; each = as_geom(dGeomGetSpace(each)))
    {
        if (each == maybe_ancestor)
            return true;
    }
    return false;
}
} // namespace

Universe::Universe(SpaceKind kind, const History &history)
    : kind_(kind), setup_(history), world_(dWorldCreate()), contacts_(dJointGroupCreate(0))
{
    setup_.operations.clear();
    dWorldSetGravity(world_, 0, 0, -history.gravity);
    dWorldSetAutoDisableFlag(world_, history.auto_disable);
    dWorldSetContactMaxCorrectingVel(world_, 3);
    Operation outermost;
    outermost.subject = 0;
    outermost.number = static_cast<int>(NestedKind::of_same_kind) + 16;
    make_space(outermost);
}

Universe::~Universe()
{
    // After an abort of ODE, spaces are still locked, and their destruction would abort again.
    if (std::uncaught_exceptions() > 0)
        return;
    for (std::size_t i = 0; i < spaces_.size(); ++i)
        destroy_space(static_cast<int>(i));
    for (GeomSlot &geom : geoms_)
    {
        if (geom.id)
            dGeomDestroy(geom.id);
    }
    dJointGroupDestroy(contacts_);
    dWorldDestroy(world_);
}

Universe::GeomSlot *Universe::find_geom(int slot)
{
    return has_slot(geoms_, slot) && geoms_[static_cast<std::size_t>(slot)].id ? &geoms_[static_cast<std::size_t>(slot)]
                                                                               : nullptr;
}

dBodyID Universe::find_body(int slot) const
{
    return has_slot(bodies_, slot) ? bodies_[static_cast<std::size_t>(slot)] : nullptr;
}

Universe::SpaceSlot *Universe::find_space(int slot)
{
    return has_slot(spaces_, slot) && spaces_[static_cast<std::size_t>(slot)].id
               ? &spaces_[static_cast<std::size_t>(slot)]
               : nullptr;
}

dGeomID Universe::find_reference(int reference)
{
    if (reference >= first_space_reference)
    {
        const SpaceSlot *space = find_space(reference - first_space_reference);
        return space ? as_geom(space->id) : nullptr;
    }
    const GeomSlot *geom = find_geom(reference);
    return geom ? geom->id : nullptr;
}

std::size_t Universe::geom_count() const
{
    return static_cast<std::size_t>(
        std::count_if(geoms_.begin(), geoms_.end(), [](const GeomSlot &geom) { return geom.id != nullptr; }));
}

void Universe::make_geom(const Operation &operation)
{
    GeomSlot &geom = slot_at(geoms_, operation.subject);
    if (geom.id)
        return;
    const SpaceSlot *space = find_space(operation.object);
    geom = GeomSlot();
    geom.kind = static_cast<GeomKind>(operation.number);
    geom.id = number_geom(create_geom(geom.kind, operation.value[0], space ? space->id : nullptr), operation.subject);
    if (is_placeable(geom.kind))
        dGeomSetPosition(geom.id, operation.value[1], operation.value[2], operation.value[3]);
}

void Universe::make_body(const Operation &operation)
{
    dBodyID &body = slot_at(bodies_, operation.subject);
    if (body)
        return;
    body = dBodyCreate(world_);
    dBodySetPosition(body, operation.value[0], operation.value[1], operation.value[2]);
    if (operation.number == 1)
        dBodySetGravityMode(body, 0);
    if (operation.number == 2)
        dBodySetKinematic(body);
}

dSpaceID Universe::create_space(NestedKind kind, dSpaceID parent) const
{
    const dVector3 centre{static_cast<dReal>(setup_.middle[0]), static_cast<dReal>(setup_.middle[1]),
                          static_cast<dReal>(setup_.middle[2])},
        extents{setup_.extent, setup_.extent, setup_.extent};
    switch (kind)
    {
    case NestedKind::hash:
        return dHashSpaceCreate(parent);
    case NestedKind::sweep_and_prune:
        return dSweepAndPruneSpaceCreate(parent, dSAP_AXES_XYZ);
    case NestedKind::quadtree:
        return dQuadTreeSpaceCreate(parent, centre, extents, 3);
    case NestedKind::of_same_kind:
        return kind_ == SpaceKind::predictive ? dPredictiveSpaceCreate(parent) : dSimpleSpaceCreate(parent);
    default:
        return dSimpleSpaceCreate(parent);
    }
}

void Universe::make_space(const Operation &operation)
{
    SpaceSlot &space = slot_at(spaces_, operation.subject);
    if (space.id)
        return;
    const SpaceSlot *found = operation.object == operation.subject ? nullptr : find_space(operation.object);
    dSpaceID parent = found ? found->id : nullptr;
    const auto nested_kind = static_cast<NestedKind>(operation.number % 16);
    SpaceSlot made;
    made.predictive = nested_kind == NestedKind::of_same_kind && kind_ == SpaceKind::predictive;
    made.needs_cleaning = !made.predictive;
    made.id = create_space(nested_kind, parent);
    if (made.predictive)
        dPredictiveSpaceSetProximity(made.id, proximity_);
    dSpaceSetCleanup(made.id, operation.number / 16);
    number_geom(as_geom(made.id), space_reference(operation.subject));
    spaces_[static_cast<std::size_t>(operation.subject)] = made;
}

// Clears the slots of everything that goes with a space that cleans up. (dSpaceGetGeom() does not work with a quadtree space.)
void Universe::forget_contents(dSpaceID space)
{
    for (GeomSlot &geom : geoms_)
        if (geom.id && dGeomGetSpace(geom.id) == space)
            geom = GeomSlot();
    for (SpaceSlot &inner : spaces_)
    {
        if (!inner.id || dGeomGetSpace(as_geom(inner.id)) != space)
            continue;
        if (dSpaceGetCleanup(inner.id))
            forget_contents(inner.id);
        inner = SpaceSlot();
    }
}

void Universe::destroy_space(int slot)
{
    SpaceSlot *space = find_space(slot);
    if (!space)
        return;
    dSpaceID id = space->id;
    if (dSpaceGetCleanup(id))
        forget_contents(id);
    spaces_[static_cast<std::size_t>(slot)] = SpaceSlot();
    dSpaceDestroy(id);
}

void Universe::destroy_body(int slot)
{
    // Contacts wait for the next step, and refer to their bodies.
    dJointGroupEmpty(contacts_);
    dBodyDestroy(bodies_[static_cast<std::size_t>(slot)]);
    bodies_[static_cast<std::size_t>(slot)] = nullptr;
}

void Universe::put_in(dGeomID geom, SpaceSlot &space)
{
    if (dGeomGetSpace(geom) || (dGeomIsSpace(geom) && is_within(space.id, geom)))
        return;
    if (space.needs_cleaning)
        dSpaceClean(space.id);
    dSpaceAdd(space.id, geom);
}

void Universe::put_offset(dGeomID geom, const Operation &operation)
{
    if (!dGeomGetBody(geom))
        return;
    dMatrix3 rotation;
    dRFromAxisAndAngle(rotation, 1, 2, 3, operation.value[3]);
    dGeomSetOffsetPosition(geom, operation.value[0], operation.value[1], operation.value[2]);
    dGeomSetOffsetRotation(geom, rotation);
}

// Geoms with an offset are left out: the place that a simple space needs for a notice would be computed with other round-off.
void Universe::change_in_place(GeomSlot &geom, dReal size)
{
    if (dGeomIsOffset(geom.id))
        return;
    if (geom.own_data)
    {
        geom.own_data->resize(size);
        return tell_of_change(geom.id);
    }
    std::unique_ptr<OwnShapeData> data = make_own_data(geom.kind, size);
    if (!data)
        return;
    data->give_to(geom.id);
    geom.own_data = data.get();
    own_data_.push_back(std::move(data));
    tell_of_change(geom.id);
}

void Universe::tell_of_change(dGeomID geom)
{
    dSpaceID space = dGeomGetSpace(geom);
    if (space && dSpaceIsPredictive(space))
        return dPredictiveSpaceGeomChanged(space, geom);
    dVector3 position;
    dGeomCopyPosition(geom, position);
    dGeomSetPosition(geom, position[0], position[1], position[2]);
}

void Universe::apply(const Operation &operation)
{
    switch (operation.action)
    {
    case Action::make_geom:
        return make_geom(operation);
    case Action::make_body:
        return make_body(operation);
    case Action::make_space:
        if (operation.subject > 0)
            make_space(operation);
        return;
    case Action::destroy_body:
        if (find_body(operation.subject))
            destroy_body(operation.subject);
        return;
    case Action::destroy_space:
        if (operation.subject > 0)
            destroy_space(operation.subject);
        return;
    case Action::step:
        return step(operation.value[0]);
    case Action::tick_broken_off:
    case Action::query_broken_off:
        if (kind_ == SpaceKind::predictive)
            break_off(operation);
        return;
    case Action::tick_throwing_bounds:
    case Action::query_throwing_bounds:
        return throw_bounds(operation);
    case Action::ask_times:
        return ask_times(operation);
    case Action::bad_call:
        if (kind_ == SpaceKind::predictive)
            call_badly(operation.number);
        return;
    default:
        break;
    }
    if (GeomSlot *geom = find_geom(operation.subject))
        apply_to_geom(operation, *geom);
    if (dBodyID body = find_body(operation.subject))
        apply_to_body(operation, body);
    if (SpaceSlot *space = find_space(operation.subject))
        apply_to_space(operation, *space);
    if (dGeomID geom = find_reference(operation.subject))
        apply_to_reference(operation, geom);
}

void Universe::apply_to_geom(const Operation &operation, GeomSlot &geom)
{
    const auto &value = operation.value;
    dMatrix3 rotation;
    const bool placeable = is_placeable(geom.kind);
    switch (operation.action)
    {
    case Action::destroy_geom:
        dJointGroupEmpty(contacts_);
        dGeomDestroy(geom.id);
        geom = GeomSlot();
        break;
    case Action::attach:
        if (placeable && (operation.object < 0 || find_body(operation.object)))
        {
            // When a geom changes its body, ODE drops an offset but not the mark to compute the place, and later aborts.
            if (operation.object >= 0)
                dGeomClearOffset(geom.id);
            dGeomSetBody(geom.id, find_body(operation.object));
        }
        break;
    case Action::offset:
        if (placeable)
            put_offset(geom.id, operation);
        break;
    case Action::clear_offset:
        if (placeable)
            dGeomClearOffset(geom.id);
        break;
    case Action::move_geom:
        if (placeable)
            dGeomSetPosition(geom.id, value[0], value[1], value[2]);
        break;
    case Action::turn_geom:
        rotation_of(operation, rotation);
        if (placeable)
            dGeomSetRotation(geom.id, rotation);
        break;
    case Action::distort_geom:
        distorted_rotation_of(operation, rotation);
        if (placeable)
            dGeomSetRotation(geom.id, rotation);
        break;
    case Action::aim_ray:
        if (geom.kind == GeomKind::ray)
            aim_ray(geom.id, operation);
        break;
    case Action::resize:
        resize_geom(geom.id, geom.kind, value[0]);
        geom.own_data = nullptr;
        break;
    case Action::change_in_place:
        change_in_place(geom, value[0]);
        break;
    case Action::enable_geom:
        (operation.number ? dGeomEnable : dGeomDisable)(geom.id);
        break;
    case Action::drive:
        geom.drive = {static_cast<DriveMode>(operation.number), {value[0], value[1], value[2]}};
        break;
    case Action::role:
        if (dGeomGetSpace(geom.id) && dSpaceIsPredictive(dGeomGetSpace(geom.id)))
            dPredictiveSpaceSetGeomRole(dGeomGetSpace(geom.id), geom.id, operation.number);
        break;
    case Action::data_changed:
        if (dGeomGetSpace(geom.id) && dSpaceIsPredictive(dGeomGetSpace(geom.id)))
            dPredictiveSpaceGeomChanged(dGeomGetSpace(geom.id), geom.id);
        break;
    default:
        break;
    }
}

void Universe::apply_to_body(const Operation &operation, dBodyID body)
{
    const auto &value = operation.value;
    dMatrix3 rotation;
    switch (operation.action)
    {
    case Action::move_body:
        dBodySetPosition(body, value[0], value[1], value[2]);
        break;
    case Action::turn_body:
        rotation_of(operation, rotation);
        dBodySetRotation(body, rotation);
        break;
    case Action::distort_body:
        distorted_rotation_of(operation, rotation);
        dBodySetRotation(body, rotation);
        break;
    case Action::enable_body:
        (operation.number ? dBodyEnable : dBodyDisable)(body);
        break;
    case Action::velocity:
        dBodySetLinearVel(body, value[0], value[1], value[2]);
        dBodySetAngularVel(body, value[3], -0.5 * value[3], 0.25 * value[3]);
        break;
    case Action::force:
        dBodyAddForce(body, value[0], value[1], value[2]);
        break;
    case Action::kinematic:
        (operation.number ? dBodySetKinematic : dBodySetDynamic)(body);
        break;
    default:
        break;
    }
}

void Universe::apply_to_space(const Operation &operation, SpaceSlot &space)
{
    switch (operation.action)
    {
    case Action::clean:
        dSpaceClean(space.id);
        break;
    case Action::deviation:
        if (space.predictive)
            dPredictiveSpaceSetDeviation(space.id, operation.number, operation.value[0], operation.value[1],
                                         operation.value[2]);
        break;
    case Action::horizon:
        if (space.predictive)
            dPredictiveSpaceSetHorizon(space.id, operation.number, operation.object);
        break;
    case Action::shape_margin:
        if (space.predictive)
            dPredictiveSpaceSetShapeMargin(space.id, operation.value[0]);
        break;
    default:
        break;
    }
}

void Universe::apply_to_reference(const Operation &operation, dGeomID geom)
{
    dReal aabb[6];
    switch (operation.action)
    {
    case Action::bits:
        dGeomSetCategoryBits(geom, static_cast<unsigned long>(operation.number % 256));
        dGeomSetCollideBits(geom, static_cast<unsigned long>(operation.number / 256));
        break;
    case Action::take_out:
        if (dGeomGetSpace(geom))
            dSpaceRemove(dGeomGetSpace(geom), geom);
        break;
    case Action::put_in:
        if (SpaceSlot *space = find_space(operation.object))
            put_in(geom, *space);
        break;
    case Action::ask_bounds:
        dGeomGetAABB(geom, aabb);
        break;
    default:
        break;
    }
}
} // namespace ode_predictive_space
