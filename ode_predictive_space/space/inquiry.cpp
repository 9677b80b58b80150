// Inquiries of a program: which geoms will meet, when, and whether the invariant holds.

#include <algorithm>
#include <limits>
#include <utility>

#include "ode_predictive_space/space/predictive_space.h"

using namespace ode_predictive_space;

std::optional<double> dxPredictiveSpace::time_of_proximity(dxGeom *first, dxGeom *second, double *apart_until)
{
    GeomScene now = scene();
    const ProxyId one = proxy_of(first), other = proxy_of(second);
    follow_shapes({one, other}, now);
    return time_of_proximity(one, other, now, apart_until);
}

// By the shape test, answers are about shapes.
void dxPredictiveSpace::follow_shapes(const std::vector<ProxyId> &ids, GeomScene &now)
{
    if (!by_shape())
        return;
    IdSet wanted;
    wanted.resize(geoms_.size());
    for (ProxyId id : ids)
        wanted.insert(id);
    broadphase_.follow_shapes(now, wanted);
}

std::optional<double> dxPredictiveSpace::time_of_proximity(ProxyId one, ProxyId other, const GeomScene &now,
                                                           double *apart_until) const
{
    *apart_until = 0;
    if (now.overlap(geoms_[one], geoms_[other]) && (!by_shape() || broadphase_.may_touch(one, other)))
        return 0.0;
    if (!broadphase_.predicted(one) || !broadphase_.predicted(other))
        return std::nullopt;
    const ProxyStore &proxies = broadphase_.proxies();
    const std::int32_t remaining =
        std::min(proxies.remaining(one, broadphase_.now()), proxies.remaining(other, broadphase_.now()));
    const bool forever = proxies.records[one].kind.still && proxies.records[other].kind.still;
    *apart_until = forever ? std::numeric_limits<double>::infinity() : static_cast<double>(remaining);
    const std::optional<ProximityInterval> interval = broadphase_.time_of_proximity(one, other);
    if (!interval)
        return std::nullopt;
    const std::optional<double> contact = by_shape() ? broadphase_.time_of_contact(one, other) : 0.0;
    return contact ? std::optional<double>(std::max(interval->enter, *contact)) : std::nullopt;
}

std::vector<dxPredictiveSpace::Encounter> dxPredictiveSpace::encounters(dxGeom *geom)
{
    const ProxyId self = proxy_of(geom);
    compute_box_beside_others(geom);
    GeomScene now = scene();
    std::vector<ProxyId> candidates{self};
    const FloatBox box = broadphase_.predicted(self) ? broadphase_.proxies().swept_box(self, broadphase_.now())
                                                     : FloatBox::around(to_box(geom->aabb));
    broadphase_.query(box, [&](ProxyId other) {
        if (other != self)
            candidates.push_back(other);
    });
    follow_shapes(candidates, now);
    std::vector<std::pair<double, ProxyId>> times;
    for (std::size_t i = 1; i < candidates.size(); ++i)
    {
        double apart_until;
        if (const auto time = time_of_proximity(self, candidates[i], now, &apart_until))
            times.emplace_back(*time, candidates[i]);
    }
    std::sort(times.begin(), times.end()); // at one time by number: never by address
    std::vector<Encounter> met;
    for (const auto &[time, id] : times)
        met.push_back({geoms_[id], time});
    return met;
}

bool dxPredictiveSpace::lies_in_envelope(ProxyId id, GeomScene &now) const
{
    const ProxyStore &proxies = broadphase_.proxies();
    Envelope envelope = proxies.outer_envelope(id, broadphase_.now());
    // The box of a geom that is checked by its centre is computed in another way. The two may differ by round-off.
    if (proxies.records[id].kind.check == Check::centre)
        envelope.deviation.a += 8 * std::numeric_limits<dReal>::epsilon() *
                                (envelope.path.position.lpNorm<Eigen::Infinity>() + envelope.radius);
    return bounds_inside(envelope, now.bounds(id));
}

std::vector<ProxyId> dxPredictiveSpace::members() const
{
    std::vector<ProxyId> members;
    broadphase_.proxies().members().for_each([&](ProxyId id) { members.push_back(id); });
    return members;
}

dxPredictiveSpace::Violation dxPredictiveSpace::find_misplaced(const std::vector<ProxyId> &members,
                                                               GeomScene &now) const
{
    if (!broadphase_.consistent())
        return {"the index of envelopes is damaged"};
    for (ProxyId id : members)
        if (broadphase_.predicted(id) ? !lies_in_envelope(id, now) : broadphase_.mode() == Mode::predicting)
            return {"a geom is outside its envelope", geoms_[id]};
    return {};
}

dxPredictiveSpace::Violation dxPredictiveSpace::find_missing_pair(const std::vector<ProxyId> &members,
                                                                  const GeomScene &now) const
{
    std::vector<std::pair<ProxyId, ProxyId>> near;
    Violation wrong_state;
    broadphase_.for_each_near_pair([&](const CandidatePair &pair, PairState state) {
        near.push_back(std::minmax(pair.first, pair.second));
        const bool overlap = now.overlap(geoms_[pair.first], geoms_[pair.second]);
        // By the shape test, pairs rest as separated whose boxes overlap.
        if (state == PairState::overlapping ? !overlap : state == PairState::separated && overlap && !by_shape())
            wrong_state = {"what is known of a pair at rest is wrong", geoms_[pair.first], geoms_[pair.second]};
    });
    if (wrong_state.what)
        return wrong_state;
    std::sort(near.begin(), near.end());
    const auto twice = std::adjacent_find(near.begin(), near.end());
    if (twice != near.end())
        return {"a pair is twice in the near set", geoms_[twice->first], geoms_[twice->second]};
    for (std::size_t i = 0; i < members.size(); ++i)
        for (std::size_t j = i + 1; j < members.size(); ++j)
        {
            dxGeom *one = geoms_[members[i]], *other = geoms_[members[j]];
            // Pairs of disabled geoms are not kept.
            if (now.overlap(one, other) && enabled(one) && enabled(other) &&
                !std::binary_search(near.begin(), near.end(), std::make_pair(members[i], members[j])))
                return {"two geoms overlap and are not in the near set", one, other};
        }
    return {};
}

// Pairs that are not reported because of their shapes must have no contacts.
dxPredictiveSpace::Violation dxPredictiveSpace::find_touching(GeomScene &now)
{
    if (!by_shape())
        return {};
    Violation touching;
    const auto check = [&](const CandidatePair &pair) {
        dxGeom *one = geoms_[pair.first], *other = geoms_[pair.second];
        dContactGeom contact;
        if (enabled(one) && enabled(other) && now.overlap(one, other) &&
            dCollide(one, other, 1, &contact, sizeof contact) > 0)
            touching = {"two geoms have a contact and are postponed", one, other};
    };
    broadphase_.for_each_postponed(now, check);
    broadphase_.for_each_near_pair([&](const CandidatePair &pair, PairState state) {
        if (state == PairState::separated)
            check(pair);
    });
    return touching;
}

dxPredictiveSpace::Violation dxPredictiveSpace::find_violation()
{
    const std::lock_guard<std::recursive_mutex> hold(upkeep_);
    forget_catching_up(); // ODE does not report that a geom was enabled
    if (!catch_up("dPredictiveSpaceValidate"))
        return {"it cannot be checked now"};
    const Lock lock(this);
    GeomScene now = scene();
    const std::vector<ProxyId> members = this->members();
    const Violation misplaced = find_misplaced(members, now);
    if (misplaced.what)
        return misplaced;
    const Violation missing = find_missing_pair(members, now);
    return missing.what ? missing : find_touching(now);
}
