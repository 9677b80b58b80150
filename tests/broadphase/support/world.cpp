#include "tests/broadphase/support/world.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"

namespace ode_predictive_space
{
namespace
{
// Boxes are closed, and NaN overlaps everything, as in ODE.
bool boxes_overlap(const Box &one, const Box &other)
{
    for (int axis = 0; axis < 3; ++axis)
        if (one.min()[axis] > other.max()[axis] || one.max()[axis] < other.min()[axis])
            return false;
    return true;
}

// A side that is NaN is inside if the outer box is infinite there.
bool holds(const FloatBox &outer, const Box &inner)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        const bool low = outer.low[axis] <= inner.min()[axis] || outer.low[axis] == -infinity;
        const bool high = inner.max()[axis] <= outer.high[axis] || outer.high[axis] == infinity;
        if (!low || !high)
            return false;
    }
    return true;
}

Vector3 reach_of(const Object &object)
{
    if (object.rotation == Object().rotation && object.formula != Watch::capsule)
        return object.half; // may be infinite
    Vector3 reach;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        const double *row = object.rotation.data() + 4 * axis;
        const double along_z = std::abs(row[2]) * object.half.z();
        const auto i = static_cast<Eigen::Index>(axis);
        reach[i] = std::abs(row[0]) * object.half.x() + std::abs(row[1]) * object.half.y() + along_z;
        if (object.formula == Watch::capsule)
            reach[i] = object.half.x() + along_z;
        if (object.formula == Watch::cylinder)
            reach[i] = object.half.x() * std::sqrt(std::max(0.0, 1 - row[2] * row[2])) + along_z;
        if (object.formula == Watch::sphere)
            reach[i] = object.half.x();
    }
    return reach;
}
} // namespace

Box bounds_of(const Object &object)
{
    const Vector3 reach = reach_of(object);
    return Box(object.centre - reach, object.centre + reach);
}

Solid solid_of(const Object &object)
{
    if (object.formula == Watch::nothing || !object.has_pose)
        return {};
    return {object.formula, static_cast<float>(object.half.x()), static_cast<float>(object.half.y()),
            static_cast<float>(object.half.z())};
}

ProxyId World::add(const Object &object)
{
    const ProxyId id = broadphase.add();
    if (id >= objects_.size())
    {
        objects_.resize(id + 1);
        present_.resize(id + 1, false);
    }
    objects_[id] = object;
    present_[id] = true;
    return id;
}

void World::remove(ProxyId id)
{
    broadphase.remove(id);
    present_[id] = false;
}

bool World::touch(ProxyId id)
{
    const Noticed noticed(objects_[id]);
    const Followed followed = broadphase.notify_at_once(id, noticed);
    return followed == Followed::moved || broadphase.notify_closely(id, noticed, followed);
}

void World::place(ProxyId id, const Vector3 &centre)
{
    objects_[id].centre = centre;
    touch(id);
}

void World::turn(ProxyId id, const Vector3 &axis, double angle)
{
    const Eigen::Matrix3d matrix = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            objects_[id].rotation[4 * row + column] =
                matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
    touch(id);
}

void World::advance()
{
    for (ProxyId id = 0; id < objects_.size(); ++id)
        if (present_[id] && !objects_[id].displacement.isZero(0))
            place(id, objects_[id].centre + objects_[id].displacement);
}

Pairs World::tick()
{
    broadphase.tick(*this);
    return report();
}

Pairs World::report()
{
    const std::size_t count = broadphase.report(*this, room_);
    Pairs pairs;
    for (std::size_t i = 0; i < count; ++i)
    {
        const auto [first, second] = room_[i];
        if (!objects_[first].enabled)
            broadphase.note_disabled(first);
        else if (!objects_[second].enabled)
            broadphase.note_disabled(second);
        else
            pairs.emplace_back(first, second);
    }
    return pairs;
}

std::vector<ProxyId> World::members() const
{
    std::vector<ProxyId> ids;
    for (ProxyId id = 0; id < present_.size(); ++id)
        if (present_[id])
            ids.push_back(id);
    return ids;
}

Pairs World::overlapping() const
{
    std::vector<ProxyId> ids = members();
    ids.erase(std::remove_if(ids.begin(), ids.end(), [this](ProxyId id) { return !objects_[id].enabled; }), ids.end());
    std::vector<Box> boxes;
    std::transform(ids.begin(), ids.end(), std::back_inserter(boxes),
                   [this](ProxyId id) { return bounds_of(seen(id)); });
    Pairs pairs;
    for (std::size_t i = 0; i < ids.size(); ++i)
        for (std::size_t j = i + 1; j < ids.size(); ++j)
            if (boxes_overlap(boxes[i], boxes[j]) && boxes_and_spheres_overlap(ids[i], ids[j]))
                pairs.emplace_back(ids[i], ids[j]);
    return pairs;
}

std::string World::misplaced_object() const
{
    const Vector3 origin = broadphase.origin().place();
    const auto here = [&](Box box) { return box.translate(-origin); };
    for (ProxyId id : members())
    {
        const Place &place = broadphase.proxies().places[id];
        if (!holds(place.envelope(), here(bounds_of(objects_[id]))))
            return "object " + std::to_string(id) + " is outside its envelope";
        if (place.watch() != Watch::centre && !holds(place.tight(), here(bounds_of(objects_[id]))))
            return "object " + std::to_string(id) + " is outside its tight box";
    }
    return {};
}

std::string World::wrong_pair(const Pairs &near) const
{
    if (std::adjacent_find(near.begin(), near.end()) != near.end())
        return "a pair is twice in the near set";
    for (const auto &pair : near)
        for (ProxyId id : {pair.first, pair.second})
            if (!present(id) || broadphase.idle(id))
                return "an object that is gone or idle is in the near set";
    for (const auto &pair : overlapping())
        if (!std::binary_search(near.begin(), near.end(), pair))
            return std::to_string(pair.first) + " and " + std::to_string(pair.second) +
                   " overlap and are not in the near set";
    return {};
}

std::string World::violated_invariant() const
{
    if (!broadphase.consistent())
        return "the index is damaged";
    const std::string misplaced = misplaced_object();
    if (!misplaced.empty())
        return misplaced;
    std::vector<CandidatePair> near;
    bool states_hold = true;
    broadphase.for_each_near_pair([&](const CandidatePair &pair, PairState state) {
        near.push_back(pair);
        if (state != PairState::active)
            states_hold &= boxes_and_spheres_overlap(pair.first, pair.second) == (state == PairState::overlapping);
    });
    return states_hold ? wrong_pair(sorted_pairs(near)) : "the state of a resting pair is wrong";
}

const Object &World::seen(ProxyId id) const
{
    EXPECT_TRUE(present(id)) << "the broad phase asks about object " << id << ", which is gone";
    return objects_[id];
}

void World::measure(const ProxyId *ids, std::size_t count, Place *places, const Origin &origin)
{
    for (std::size_t i = 0; i < count; ++i)
    {
        const Object &object = seen(ids[i]);
        Place &place = places[ids[i]];
        if (!place.measure(solid_of(object), object.centre.data(), object.rotation.data(), origin))
            place.set_tight(origin.around(bounds_of(object)));
    }
}

void World::observe(const ProxyId *ids, std::size_t count, Observation *seen, const Origin &)
{
    for (std::size_t i = 0; i < count; ++i)
        seen[i] = observation(ids[i]);
}

void World::find_disabled(const std::vector<ProxyId> &ids, IdSet &disabled)
{
    for (ProxyId id : ids)
        if (!seen(id).enabled)
            disabled.insert(id);
}

std::optional<Vector3> World::pivot_of(ProxyId id) const
{
    const Object &object = seen(id);
    const bool known = std::isfinite(object.radius) || object.velocity;
    return known && object.centre.allFinite() ? std::optional(object.centre) : std::nullopt;
}

SampledPose World::pose(ProxyId id)
{
    const Object &object = seen(id);
    const std::array<double, 12> &R = object.rotation;
    SampledPose pose{object.centre, Eigen::Matrix3d(), 1e-15 * object.centre.norm(), true};
    pose.rotation << R[0], R[1], R[2], R[4], R[5], R[6], R[8], R[9], R[10];
    return pose;
}

Observation World::observation(ProxyId id) const
{
    const Object &object = seen(id);
    Observation seen;
    seen.centre = pivot_of(id);
    seen.radius = seen.centre ? object.radius : infinity;
    seen.velocity = object.velocity;
    return seen;
}

bool World::boxes_and_spheres_overlap(ProxyId first, ProxyId second) const
{
    if (!boxes_overlap(bounds_of(seen(first)), bounds_of(seen(second))))
        return false;
    // An object without a bounding sphere has the one around its box. The tolerance is for rounding on both sides.
    auto radius = [this](ProxyId id) {
        return std::isfinite(objects_[id].radius) ? objects_[id].radius : objects_[id].half.norm();
    };
    const double reach = (radius(first) + radius(second)) * (1 - 1e-9);
    return broadphase.proximity_test() == ProximityTest::box ||
           !((objects_[first].centre - objects_[second].centre).squaredNorm() > reach * reach);
}

Object ball(const Vector3 &centre, double radius, const Vector3 &displacement)
{
    return {centre,        Vector3::Constant(radius),           radius,
            Watch::sphere, Vector3(displacement / World::step), displacement};
}

Object capsule(const Vector3 &centre, double radius, double half_segment, const Vector3 &displacement)
{
    return {centre,         {radius, radius, half_segment},      (radius + half_segment) * (1 + 1e-9),
            Watch::capsule, Vector3(displacement / World::step), displacement};
}

Object block(const Vector3 &centre, const Vector3 &half, const Vector3 &displacement, bool with_body)
{
    Object result = {centre, half, infinity, Watch::nothing, std::nullopt, displacement};
    if (with_body)
    {
        result.radius = half.norm() * (1 + 1e-9);
        result.velocity = displacement / World::step;
    }
    return result;
}

Object box(const Vector3 &centre, const Vector3 &half, const Vector3 &displacement, bool with_body)
{
    Object result = block(centre, half, displacement, with_body);
    result.formula = Watch::box;
    return result;
}

Object floor_below(double height)
{
    // A box around a centre cannot have the bounds -infinity and height, so it is made of a large one.
    return block({0, 0, height - 1e30}, {infinity, infinity, 1e30}, Vector3::Zero(), false);
}
} // namespace ode_predictive_space
