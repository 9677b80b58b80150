#include "ode_predictive_space/preload/pairs.h"

#include <algorithm>
#include <cstring>

#include "ode_predictive_space/space/ode_internals.h"

namespace ode_predictive_space::preload
{
namespace
{
dSpaceID as_space(dGeomID geom)
{
    return dGeomIsSpace(geom) ? reinterpret_cast<dSpaceID>(geom) : nullptr;
}

// ODE's rule, of two spaces, for the one that looks (first) and the one whose geoms it is shown, or 0 when it is shown the
// other as one geom.
struct Roles
{
    dxSpace *looks;
    dxGeom *shown;
    bool each_geom; // of the shown one, which is a space
};

Roles roles_of(dGeomID first, dGeomID second)
{
    dSpaceID one = as_space(first), other = as_space(second);
    if (one && other && one->sublevel != other->sublevel)
        (one->sublevel > other->sublevel ? other : one) = nullptr;
    if (one && other)
        return one->count < other->count ? Roles{other, first, true} : Roles{one, second, true};
    return one ? Roles{one, second, false} : Roles{other, first, false};
}

std::vector<dxGeom *> with_bounds(dxSpace *space)
{
    std::vector<dxGeom *> geoms;
    for (dxGeom *geom = space->first; geom; geom = geom->next)
    {
        geom->recomputeAABB();
        geoms.push_back(geom);
    }
    return geoms;
}

bool overlap(const dReal *first, const dReal *second)
{
    for (int axis = 0; axis < 6; axis += 2)
        if (first[axis] > second[axis + 1] || first[axis + 1] < second[axis])
            return false;
    return true;
}

std::uint64_t mix(std::uint64_t hash, std::uint64_t value)
{
    hash = (hash ^ value) * 0x9e3779b97f4a7c15ULL;
    return hash ^ (hash >> 29);
}

std::uint64_t mix(std::uint64_t hash, dReal value)
{
    const double number = value;
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    return mix(hash, bits);
}
} // namespace

bool may_collide(dGeomID first, dGeomID second)
{
    return (first->body != second->body || !first->body) &&
           ((first->category_bits & second->collide_bits) != 0 || (second->category_bits & first->collide_bits) != 0);
}

bool is_enabled(dGeomID geom)
{
    return (geom->gflags & GEOM_ENABLE_TEST_MASK) == GEOM_ENABLE_TEST_VALUE;
}

bool boxes_overlap(dGeomID first, dGeomID second)
{
    return overlap(first->aabb, second->aabb) && first->AABBTest(second, second->aabb) &&
           second->AABBTest(first, first->aabb);
}

std::vector<Pair> expected_pairs(dSpaceID space)
{
    std::vector<Pair> pairs;
    const std::vector<dxGeom *> geoms = with_bounds(space);
    for (std::size_t i = 0; i < geoms.size(); ++i)
        for (std::size_t j = i + 1; j < geoms.size() && is_enabled(geoms[i]); ++j)
            if (is_enabled(geoms[j]) && may_collide(geoms[i], geoms[j]) && boxes_overlap(geoms[i], geoms[j]))
                pairs.emplace_back(geoms[i], geoms[j]);
    return pairs;
}

dSpaceID asked_space(dGeomID first, dGeomID second)
{
    return roles_of(first, second).looks;
}

std::vector<Pair> expected_pairs(dGeomID first, dGeomID second)
{
    const Roles roles = roles_of(first, second);
    if (!roles.looks)
        return {};
    if (roles.looks == roles.shown)
        return expected_pairs(roles.looks);
    std::vector<dxGeom *> shown = {roles.shown};
    if (roles.each_geom)
        shown = with_bounds(static_cast<dxSpace *>(roles.shown));
    std::vector<Pair> pairs;
    const std::vector<dxGeom *> geoms = with_bounds(roles.looks);
    for (dxGeom *each : shown)
    {
        each->recomputeAABB();
        for (dxGeom *geom : geoms)
            if (is_enabled(geom) && may_collide(geom, each) && boxes_overlap(geom, each))
                pairs.emplace_back(geom, each);
    }
    return pairs;
}

std::uint64_t fingerprint(dGeomID geom)
{
    dReal bounds[6];
    dGeomGetAABB(geom, bounds);
    std::uint64_t hash = mix(1, static_cast<std::uint64_t>(geom->type));
    for (dReal bound : bounds)
        hash = mix(hash, bound);
    hash = mix(hash, static_cast<std::uint64_t>(geom->category_bits));
    hash = mix(hash, static_cast<std::uint64_t>(geom->collide_bits));
    if (geom->type == dPlaneClass) // its box is infinite
    {
        dVector4 parameters;
        dGeomPlaneGetParams(geom, parameters);
        for (dReal parameter : parameters)
            hash = mix(hash, parameter);
    }
    return hash;
}

std::uint64_t put_in_order(std::vector<Pair> &pairs)
{
    using Key = std::pair<std::uint64_t, std::uint64_t>;
    std::vector<std::pair<Key, std::size_t>> keyed;
    for (Pair &pair : pairs)
    {
        Key key(fingerprint(pair.first), fingerprint(pair.second));
        if (key.second < key.first)
        {
            std::swap(key.first, key.second);
            std::swap(pair.first, pair.second);
        }
        keyed.emplace_back(key, keyed.size());
    }
    std::sort(keyed.begin(), keyed.end()); // alike pairs stay in their order
    const std::vector<Pair> unordered = pairs;
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < keyed.size(); ++i)
    {
        pairs[i] = unordered[keyed[i].second];
        hash = mix(mix(hash, keyed[i].first.first), keyed[i].first.second);
    }
    return hash;
}
} // namespace ode_predictive_space::preload
