#include <algorithm>
#include <cmath>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/kept_pose.h"
#include "tests/differential/universe.h"

namespace ode_predictive_space
{
namespace
{
// The lower number comes first: dSpaceCollide2() of two spaces of one size ignores whether geoms of the second are enabled.
void record_and_recurse(void *data, dGeomID first, dGeomID second)
{
    static_cast<Pairs *>(data)->push_back({geom_number(first), geom_number(second)});
    if (!dGeomIsSpace(first) && !dGeomIsSpace(second))
        return;
    if (geom_number(second) < geom_number(first))
        std::swap(first, second);
    dSpaceCollide2(first, second, data, record_and_recurse);
}
} // namespace

void Universe::move_driven()
{
    for (GeomSlot &geom : geoms_)
    {
        if (!geom.id || geom.drive.mode == DriveMode::none || !is_placeable(geom.kind))
            continue;
        if (geom.drive.mode == DriveMode::jerking && steps_ % 7 > 2)
            continue;
        const double factor = geom.drive.mode == DriveMode::swinging ? std::sin(0.05 * static_cast<double>(steps_)) : 1;
        dVector3 position;
        dGeomCopyPosition(geom.id, position);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const dReal way = position[axis] - static_cast<dReal>(setup_.middle[axis]);
            const bool outside = std::fabs(way) > setup_.extent;
            if (outside && way * geom.drive.velocity[axis] > 0)
                geom.drive.velocity[axis] = -geom.drive.velocity[axis];
            position[axis] += factor * geom.drive.velocity[axis];
        }
        dGeomSetPosition(geom.id, position[0], position[1], position[2]);
    }
}

void Universe::turn_back()
{
    for (dBodyID body : bodies_)
    {
        if (!body)
            continue;
        const dReal *position = dBodyGetPosition(body);
        const dReal *velocity = dBodyGetLinearVel(body);
        dReal turned[3] = {velocity[0], velocity[1], velocity[2]};
        bool turns = false;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const dReal way = position[axis] - static_cast<dReal>(setup_.middle[axis]);
            if (std::fabs(way) > setup_.extent && way * velocity[axis] > 0)
            {
                turned[axis] = -velocity[axis];
                turns = true;
            }
        }
        if (turns)
            dBodySetLinearVel(body, turned[0], turned[1], turned[2]);
    }
}

void Universe::step(double seconds)
{
    ++steps_;
    move_driven();
    turn_back();
    dRandSetSeed(steps_);
    dWorldQuickStep(world_, seconds);
    dJointGroupEmpty(contacts_);
}

bool Universe::can_touch(int number) const
{
    if (number >= first_space_reference)
        return false;
    const GeomSlot &geom = geoms_[static_cast<std::size_t>(number)];
    if (geom.kind == GeomKind::plane)
        return true;
    if (geom.kind != GeomKind::sphere && geom.kind != GeomKind::box && geom.kind != GeomKind::capsule)
        return false;
    const dReal *position = dGeomGetPosition(geom.id);
    // Contacts at the ends of the world would be as deep as they are far; the result is false also for NaN.
    double distance = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        distance += std::fabs(position[axis] - setup_.middle[axis]);
    return distance < 10 * setup_.extent;
}

void Universe::make_contacts(const Pairs &pairs)
{
    dJointGroupEmpty(contacts_);
    for (const Pair &pair : pairs)
    {
        if (!can_touch(pair.first) || !can_touch(pair.second))
            continue;
        dGeomID first = geoms_[static_cast<std::size_t>(pair.first)].id;
        dGeomID second = geoms_[static_cast<std::size_t>(pair.second)].id;
        if (!dGeomGetBody(first) && !dGeomGetBody(second))
            continue;
        dContact contacts[3] = {};
        const int count = dCollide(first, second, 3, &contacts[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i)
        {
            contacts[i].surface.mode = dContactApprox1;
            contacts[i].surface.mu = 0.5;
            dJointID joint = dJointCreateContact(world_, contacts_, &contacts[i]);
            dJointAttach(joint, dGeomGetBody(first), dGeomGetBody(second));
        }
    }
}

Pairs Universe::tick()
{
    ++ticks_;
    Pairs pairs;
    dSpaceCollide(spaces_[0].id, &pairs, record_and_recurse);
    pairs = unordered(pairs);
    if (setup_.contacts)
        make_contacts(pairs);
    for (std::size_t i = 1; i < spaces_.size(); ++i)
    {
        if (spaces_[i].id && ticks_ % i == 0)
            dSpaceCollide(spaces_[i].id, &pairs, record_and_recurse);
    }
    return unordered(pairs);
}

Pairs Universe::query(int first, int second)
{
    dGeomID one = find_reference(first);
    dGeomID other = find_reference(second);
    if (!one || !other)
        return {};
    Pairs pairs = collide2(one, other);
    if (one == other)
        return unordered(pairs);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

namespace
{
// This query makes a space predict everything from then on, new geoms too. It comes early in some spaces and late in others.
void ask_sometimes(dSpaceID space)
{
    if (dSpaceGetNumGeoms(space) % 8 == 5)
        dPredictiveSpaceGetEncounters(space, dSpaceGetGeom(space, 0), nullptr, 0);
}
} // namespace

// With the shape test, validation calls dCollide(), too. If that stops at an assertion, the poses are restored.
bool Universe::valid() const
{
    const auto is_valid = [](const SpaceSlot &space) {
        if (!space.id || !space.predictive)
            return true;
        ask_sometimes(space.id);
        return dPredictiveSpaceValidate(space.id) != 0;
    };
    if (proximity_ != dPredictiveProximityShape)
        return std::all_of(spaces_.begin(), spaces_.end(), is_valid);
    std::vector<KeptPose> poses;
    for (const GeomSlot &geom : geoms_)
        if (geom.id)
            poses.emplace_back(geom.id);
    try
    {
        return std::all_of(spaces_.begin(), spaces_.end(), is_valid);
    }
    catch (const OdeAbort &)
    {
        for (const KeptPose &pose : poses)
            pose.restore();
        return true;
    }
}

void Universe::measure_by(int proximity)
{
    proximity_ = proximity;
    for (const SpaceSlot &space : spaces_)
    {
        if (space.id && space.predictive)
            dPredictiveSpaceSetProximity(space.id, proximity);
    }
}

Pairs Universe::tick_asking()
{
    struct Asked
    {
        dGeomID space;
        Pairs pairs;
    } asked{as_geom(spaces_[0].id), {}};
    dSpaceCollide(spaces_[0].id, &asked, [](void *data, dGeomID first, dGeomID second) {
        Asked &asked = *static_cast<Asked *>(data);
        // The lower number is taken, as the order of the geoms in a callback is not specified.
        dGeomID asking = geom_number(first) < geom_number(second) ? first : second;
        asked.pairs.push_back({geom_number(first), geom_number(second)});
        if (!dGeomIsSpace(asking))
            for (const Pair &pair : collide2(asked.space, asking))
                asked.pairs.push_back(pair);
    });
    return unordered(asked.pairs);
}

namespace
{
struct BrokenOff
{
    int spared; // callbacks before the one that throws
};

void break_off_later(void *data, dGeomID, dGeomID)
{
    if (static_cast<BrokenOff *>(data)->spared-- == 0)
        throw BrokenOff();
}
} // namespace

// A predictive space is exact afterwards; a simple one would stay locked.
void Universe::break_off(const Operation &operation)
{
    BrokenOff later{operation.number};
    dGeomID one = find_reference(operation.subject), other = find_reference(operation.object);
    const auto is_locked_by_exceptions = [](dGeomID geom) {
        return dGeomIsSpace(geom) && !dSpaceIsPredictive(as_space(geom));
    };
    try
    {
        if (operation.action == Action::tick_broken_off)
            dSpaceCollide(spaces_[0].id, &later, break_off_later);
        else if (one && other && !is_locked_by_exceptions(one) && !is_locked_by_exceptions(other))
            dSpaceCollide2(one, other, &later, break_off_later);
    }
    catch (const BrokenOff &)
    {}
}

// A simple space would stay locked if it computes the box.
void Universe::throw_bounds(const Operation &operation)
{
    const bool all_predictive = std::all_of(spaces_.begin(), spaces_.end(),
                                            [](const SpaceSlot &space) { return !space.id || space.predictive; });
    if (!all_predictive)
        return;
    dGeomID one = find_reference(operation.subject), other = find_reference(operation.object);
    const auto ignore = [](void *, dGeomID, dGeomID) {};
    const ThrowingBounds throwing(operation.number);
    try
    {
        if (operation.action == Action::tick_throwing_bounds)
            dSpaceCollide(spaces_[0].id, nullptr, ignore);
        else if (one && other)
            dSpaceCollide2(one, other, nullptr, ignore);
    }
    catch (const ThrowingBounds::Thrown &)
    {}
}

void Universe::ask_times(const Operation &operation)
{
    const GeomSlot *one = find_geom(operation.subject), *other = find_geom(operation.object);
    dSpaceID space = one ? dGeomGetSpace(one->id) : nullptr;
    if (!space || !dSpaceIsPredictive(space))
        return;
    std::vector<dPredictiveEncounter> encounters(static_cast<std::size_t>(operation.number));
    const int count = dPredictiveSpaceGetEncounters(space, one->id, encounters.data(), operation.number);
    const bool sorted = std::is_sorted(encounters.begin(), encounters.begin() + count,
                                       [](const auto &a, const auto &b) { return a.ticks < b.ticks; });
    dReal ticks = 0;
    if (other && other != one && dGeomGetSpace(other->id) == space)
        dPredictiveSpaceGetTimeOfProximity(space, one->id, other->id, &ticks);
    if (!sorted || !(ticks >= 0))
        throw OdeAbort("times of encounters are wrong");
}

void Universe::call_badly(int which)
{
    dSpaceID space = spaces_[0].id;
    const auto is_refused = [&](auto call) {
        if (ode_complaint(call).find("bad argument") == std::string::npos)
            throw OdeAbort("bad call " + std::to_string(which) + " was not refused");
    };
    switch (which % 6)
    {
    case 0:
        return is_refused([&] { dPredictiveSpaceSetProximity(space, 3 + which); });
    case 1:
        return is_refused([&] { dPredictiveSpaceSetHorizon(space, -which, which); });
    case 2:
        return is_refused([&] { dPredictiveSpaceSetDeviation(space, which, 0, 0, 0); });
    case 3:
        return is_refused([&] { dPredictiveSpaceGetEncounters(space, nullptr, nullptr, which); });
    case 4:
        return is_refused([&] { dPredictiveSpaceSetGeomRole(space, as_geom(space), 0); });
    default:
        return is_refused([&] { dPredictiveSpaceSetShapeMargin(space, -which); });
    }
}

int Universe::contacts_between(int first, int second) const
{
    return ode_predictive_space::contacts_between(geoms_[static_cast<std::size_t>(first)].id,
                                                  geoms_[static_cast<std::size_t>(second)].id);
}
} // namespace ode_predictive_space
