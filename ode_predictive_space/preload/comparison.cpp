#include "ode_predictive_space/preload/comparison.h"

#include <functional>

#include <ode/collision.h>

namespace ode_predictive_space::preload
{
namespace
{
Pair unordered(Pair pair)
{
    return std::less<dGeomID>()(pair.second, pair.first) ? Pair(pair.second, pair.first) : pair;
}

bool touch(const Pair &pair)
{
    dContactGeom contact;
    return dGeomIsSpace(pair.first) || dGeomIsSpace(pair.second) ||
           dCollide(pair.first, pair.second, 1, &contact, sizeof contact) > 0;
}
} // namespace

Comparison::Comparison(const std::vector<Pair> &expected, bool contacts_only)
{
    for (const Pair &pair : expected)
    {
        expected_.insert(unordered(pair));
        if (!contacts_only || touch(pair))
            required_.insert(unordered(pair));
    }
}

void Comparison::note(dGeomID first, dGeomID second)
{
    const Pair pair = unordered({first, second});
    if (!reported_.insert(pair).second)
        differences_.push_back({"reported twice", pair});
    // Expected or not before: an earlier callback may have changed what holds now.
    else if (expected_.count(pair) == 0 && !(may_collide(first, second) && boxes_overlap(first, second)))
        differences_.push_back({"reported although apart", pair});
}

std::vector<Difference> Comparison::finish()
{
    for (const Pair &pair : required_)
        if (reported_.count(pair) == 0 && is_enabled(pair.first) && is_enabled(pair.second) &&
            may_collide(pair.first, pair.second))
            differences_.push_back({"not reported", pair});
    return std::move(differences_);
}
} // namespace ode_predictive_space::preload
