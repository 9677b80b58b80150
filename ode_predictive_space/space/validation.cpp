// Validation of the invariant by brute force.

#include <algorithm>
#include <limits>
#include <utility>

#include "ode_predictive_space/space/predictive_space.h"

using namespace ode_predictive_space;

// A side of `box` may be NaN only where `outer` is infinite.
static bool is_within(const FloatBox &outer, const Box &box)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
    {
        within &= outer.low[axis] <= box.min()[axis] || outer.low[axis] == -infinity;
        within &= box.max()[axis] <= outer.high[axis] || outer.high[axis] == infinity;
    }
    return within;
}

dxPredictiveSpace::Violation dxPredictiveSpace::find_misplaced(const std::vector<ProxyId> &members,
                                                               GeomScene &now) const
{
    if (!broadphase_.consistent())
        return {"the index of envelopes is damaged"};
    for (ProxyId id : members)
    {
        const Place &place = broadphase_.proxies().places[id];
        const Box bounds = Box(now.bounds(id)).translate(-broadphase_.origin().place());
        if (!is_within(place.envelope(), bounds))
            return {"a geom is outside its envelope", geoms_[id]};
        if (!place.watches_centre() && !is_within(place.tight(), bounds))
            return {"a geom is outside its tight box", geoms_[id]};
    }
    return {};
}

dxPredictiveSpace::Violation dxPredictiveSpace::find_missing_pair(const std::vector<ProxyId> &members,
                                                                  const GeomScene &now) const
{
    std::vector<std::pair<ProxyId, ProxyId>> near_pairs;
    Violation wrong_state;
    broadphase_.for_each_near_pair([&](const CandidatePair &pair, PairState state) {
        near_pairs.push_back(std::minmax(pair.first, pair.second));
        const bool overlap = now.overlap(geoms_[pair.first], geoms_[pair.second]);
        // With the shape test, a pair whose boxes overlap may rest as separated.
        if (state == PairState::overlapping ? !overlap : state == PairState::separated && overlap && !by_shape())
            wrong_state = {"the state of a resting pair is wrong", geoms_[pair.first], geoms_[pair.second]};
    });
    if (wrong_state.what)
        return wrong_state;
    std::sort(near_pairs.begin(), near_pairs.end());
    const auto twice = std::adjacent_find(near_pairs.begin(), near_pairs.end());
    if (twice != near_pairs.end())
        return {"a pair is twice in the near set", geoms_[twice->first], geoms_[twice->second]};
    for (std::size_t i = 0; i < members.size(); ++i)
        for (std::size_t j = i + 1; j < members.size(); ++j)
        {
            dxGeom *one = geoms_[members[i]], *other = geoms_[members[j]];
            // The near set keeps no pairs of disabled geoms.
            if (now.overlap(one, other) && enabled(one) && enabled(other) &&
                !std::binary_search(near_pairs.begin(), near_pairs.end(), std::make_pair(members[i], members[j])))
                return {"two geoms overlap and are not in the near set", one, other};
        }
    return {};
}

// A pair that is not reported because of its shapes must have no contact.
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
            touching = {"two geoms with a contact are postponed", one, other};
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
    const std::lock_guard<std::recursive_mutex> hold(access_.upkeep);
    access_.forget_catching_up(); // ODE sends no notice when a geom is enabled
    if (!catch_up("dPredictiveSpaceValidate"))
        return {"the space cannot be checked while it is being updated"};
    const Lock lock(this);
    GeomScene now = scene();
    broadphase_.find_new_pairs(now);
    std::vector<ProxyId> members;
    broadphase_.proxies().members().for_each([&](ProxyId id) { members.push_back(id); });
    const Violation misplaced = find_misplaced(members, now);
    if (misplaced.what)
        return misplaced;
    const Violation missing = find_missing_pair(members, now);
    return missing.what ? missing : find_touching(now);
}
