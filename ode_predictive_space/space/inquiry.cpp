// What a program can ask a predictive space: what will meet, when, and whether all is well.

#include <algorithm>
#include <limits>

#include "ode_predictive_space/broadphase/verify.h"
#include "ode_predictive_space/space/predictive_space.h"

using namespace ode_predictive_space;

std::optional<double> dxPredictiveSpace::time_of_proximity(dxGeom *first, dxGeom *second, double *apart_until) const
{
    const ProxyId one = proxy_of(first), other = proxy_of(second);
    *apart_until = 0;
    if (scene().overlap(one, other))
        return 0.0;
    if (!broadphase_.predicted(one) || !broadphase_.predicted(other))
        return std::nullopt;
    const ProxyStore &proxies = broadphase_.proxies();
    const std::int32_t remaining =
        std::min(proxies.remaining(one, broadphase_.now()), proxies.remaining(other, broadphase_.now()));
    const bool forever = proxies.bounds[one].still && proxies.bounds[other].still;
    *apart_until = forever ? std::numeric_limits<double>::infinity() : static_cast<double>(remaining);
    const std::optional<ProximityInterval> interval = broadphase_.proximity(one, other);
    return interval ? std::optional<double>(interval->enter) : std::nullopt;
}

std::vector<dxPredictiveSpace::Encounter> dxPredictiveSpace::encounters(dxGeom *geom) const
{
    const ProxyId self = proxy_of(geom);
    geom->recomputeAABB();
    std::vector<Encounter> met;
    const FloatBox box = broadphase_.predicted(self) ? broadphase_.proxies().swept_box(self, broadphase_.now())
                                                     : FloatBox::around(to_box(geom->aabb));
    broadphase_.query(box, [&](ProxyId other) {
        double apart_until;
        if (other == self)
            return;
        if (const auto time = time_of_proximity(geom, geoms_[other], &apart_until))
            met.push_back({geoms_[other], *time});
    });
    std::stable_sort(met.begin(), met.end(), [](const Encounter &a, const Encounter &b) { return a.ticks < b.ticks; });
    return met;
}

bool dxPredictiveSpace::lies_in_envelope(ProxyId id, const GeomScene &now) const
{
    const ProxyStore &proxies = broadphase_.proxies();
    Envelope envelope = proxies.outer_envelope(id, broadphase_.now());
    // What is checked by its centre has its box computed another way: the two may differ by rounding.
    if (proxies.bounds[id].check == Check::centre)
        envelope.deviation.a += 8 * std::numeric_limits<dReal>::epsilon() *
                                (envelope.path.position.lpNorm<Eigen::Infinity>() + envelope.radius);
    return bounds_inside(envelope, now.bounds(id));
}

const char *dxPredictiveSpace::find_violation()
{
    Lock lock(this);
    GeomScene now = scene();
    std::vector<ProxyId> members;
    for (ProxyId id = 0; id < geoms_.size(); ++id)
        if (geoms_[id])
            members.push_back(id);
    if (!broadphase_.consistent())
        return "the index of envelopes is damaged";
    for (ProxyId id : members)
        if (broadphase_.predicted(id) ? !lies_in_envelope(id, now) : !broadphase_.scanning())
            return "a geom is outside its envelope";

    std::vector<std::pair<ProxyId, ProxyId>> near;
    bool verdicts_hold = true;
    broadphase_.each_near([&](const CandidatePair &pair, NearSet::Verdict verdict) {
        near.push_back(std::minmax(pair.first, pair.second));
        if (verdict != NearSet::Verdict::open)
            verdicts_hold &= now.overlap(pair.first, pair.second) == (verdict == NearSet::Verdict::together);
    });
    if (!verdicts_hold)
        return "what is known of a pair at rest is wrong";
    std::sort(near.begin(), near.end());
    if (std::adjacent_find(near.begin(), near.end()) != near.end())
        return "a pair is twice in the near set";
    for (std::size_t i = 0; i < members.size(); ++i)
        for (std::size_t j = i + 1; j < members.size(); ++j)
            if (now.overlap(members[i], members[j]) &&
                !std::binary_search(near.begin(), near.end(), std::make_pair(members[i], members[j])))
                return "two geoms overlap and are not in the near set";
    return nullptr;
}
