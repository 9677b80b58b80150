#include "tests/broadphase/support/world.h"

#include <functional>

namespace ode_predictive_space
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

// Closed; what is not a number overlaps, as it does for ODE.
bool boxes_overlap(const Box &one, const Box &other)
{
    for (int axis = 0; axis < 3; ++axis)
        if (one.min()[axis] > other.max()[axis] || one.max()[axis] < other.min()[axis])
            return false;
    return true;
}

// A side that is NaN is inside where the outer box is infinite.
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

// What the broad phase asks at the notice of a move.
struct Noticed
{
    const Object &object;

    bool has_centre() const { return true; }
    const double *coordinates() const { return object.centre.data(); }
    bool has_grown(float radius) const { return !(object.radius <= radius); }
    std::uint32_t pose_digest() const
    {
        const std::hash<double> digest;
        return static_cast<std::uint32_t>(digest(object.centre.x()) + 3 * digest(object.centre.y()) +
                                          5 * digest(object.centre.z()));
    }
};
} // namespace

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
    // Whoever asks for it nevertheless gets an answer that spoils the test.
    objects_[id] = Object{};
}

void World::touch(ProxyId id)
{
    broadphase.notice_move(id, Noticed{objects_[id]});
}

void World::place(ProxyId id, const Vector3 &centre)
{
    objects_[id].centre = centre;
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
        pairs.emplace_back(room_[i].first, room_[i].second);
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
    return all_pairs(objects_.size(), [this](ProxyId first, ProxyId second) {
        return present_[first] && present_[second] && overlap(first, second);
    });
}

std::string World::violated_invariant()
{
    if (!broadphase.consistent())
        return "the index is damaged";
    if (!broadphase.scanning())
        for (ProxyId id : members())
            if (!holds(FloatBox::around(broadphase.proxies().envelope(id, broadphase.now()).at(0)), bounds(id)))
                return "object " + std::to_string(id) + " is outside its envelope";
    std::vector<CandidatePair> current;
    bool verdicts_hold = true;
    broadphase.each_near([&](const CandidatePair &pair, NearSet::Verdict verdict) {
        current.push_back({pair.first, pair.second});
        if (verdict != NearSet::Verdict::open)
            verdicts_hold &= overlap(pair.first, pair.second) == (verdict == NearSet::Verdict::together);
    });
    if (!verdicts_hold)
        return "what is known of a pair at rest is wrong";
    const Pairs near = sorted_pairs(current);
    if (std::adjacent_find(near.begin(), near.end()) != near.end())
        return "a pair is twice in the near set";
    for (const auto &pair : near)
        if (!present(pair.first) || !present(pair.second))
            return "an object that is gone is in the near set";
    for (const auto &pair : overlapping())
        if (!std::binary_search(near.begin(), near.end(), pair))
            return std::to_string(pair.first) + " and " + std::to_string(pair.second) +
                   " overlap and are not in the near set";
    return {};
}

std::optional<Vector3> World::pivot(ProxyId id) const
{
    const Object &object = objects_[id];
    const bool known = std::isfinite(object.radius) || object.velocity;
    return known && object.centre.allFinite() ? std::optional(object.centre) : std::nullopt;
}

Observation World::observe(ProxyId id, bool with_bounds) const
{
    const Object &object = objects_[id];
    Observation seen;
    seen.radius = object.radius;
    seen.is_sphere = object.is_sphere;
    seen.centre = pivot(id);
    seen.velocity = object.velocity;
    if (!seen.centre || !std::isfinite(object.radius) || (with_bounds && !object.is_sphere))
        seen.bounds = bounds(id);
    return seen;
}

bool World::overlap(ProxyId first, ProxyId second) const
{
    if (!boxes_overlap(bounds(first), bounds(second)))
        return false;
    // The sphere of what has none is that around its box. The tolerance is for rounding, here and in the broad phase.
    auto radius = [this](ProxyId id) {
        return std::isfinite(objects_[id].radius) ? objects_[id].radius : objects_[id].half.norm();
    };
    const double reach = (radius(first) + radius(second)) * (1 - 1e-9);
    return broadphase.measure() == Proximity::box ||
           !((objects_[first].centre - objects_[second].centre).squaredNorm() > reach * reach);
}

Object ball(const Vector3 &centre, double radius, const Vector3 &displacement)
{
    return {centre, Vector3::Constant(radius), radius, true, Vector3(displacement / World::step), displacement};
}

Object box(const Vector3 &centre, const Vector3 &half, const Vector3 &displacement, bool with_body)
{
    Object result = {centre, half, infinity, false, std::nullopt, displacement};
    if (with_body)
    {
        result.radius = half.norm() * (1 + 1e-9);
        result.velocity = displacement / World::step;
    }
    return result;
}

Object floor_below(double height)
{
    // Its bounds are -infinity and height; the box around its centre cannot say that, so it is made of a large one.
    return box({0, 0, height - 1e30}, {infinity, infinity, 1e30}, Vector3::Zero(), false);
}
} // namespace ode_predictive_space
