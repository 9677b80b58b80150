#include "ode_predictive_space/preload/pairs.h"

#include <algorithm>
#include <cstring>

#include "ode_predictive_space/ode/internals.h"

namespace ode_predictive_space::preload
{
namespace
{
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
// A hash of class, box and bits: equal in all runs in which the geom is in the same place.
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
} // namespace

dSpaceID asked_space(dGeomID first, dGeomID second)
{
    const auto as_space = [](dGeomID geom) { return dGeomIsSpace(geom) ? reinterpret_cast<dSpaceID>(geom) : nullptr; };
    const dSpaceID one = as_space(first), other = as_space(second);
    if (!one || !other)
        return one ? one : other;
    // ODE asks the space with the higher sublevel, or else the one with more geoms.
    if (one->sublevel != other->sublevel)
        return one->sublevel > other->sublevel ? one : other;
    return one->count < other->count ? other : one;
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
    std::sort(keyed.begin(), keyed.end());
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
