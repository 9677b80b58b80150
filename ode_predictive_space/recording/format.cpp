#include "ode_predictive_space/recording/format.h"

#include <algorithm>

#include <ode/collision.h>

namespace ode_predictive_space::recording
{
int size_count(int geom_class)
{
    switch (geom_class)
    {
    case dSphereClass:
    case dRayClass:
        return 1;
    case dCapsuleClass:
    case dCylinderClass:
        return 2;
    case dBoxClass:
        return 3;
    case dPlaneClass:
        return 4;
    case stand_in:
        return 6;
    default:
        return 0;
    }
}

bool is_space_class(int geom_class)
{
    return geom_class >= dFirstSpaceClass && geom_class <= dLastSpaceClass;
}

bool is_heightfield(int geom_class)
{
    return geom_class == dHeightfieldClass || geom_class == fixed_heightfield;
}

bool has_data(int geom_class)
{
    return geom_class == dTriMeshClass || geom_class == dConvexClass || is_heightfield(geom_class);
}

bool is_placeable_class(int geom_class)
{
    return geom_class != dPlaneClass && geom_class != stand_in && geom_class != fixed_heightfield &&
           !is_space_class(geom_class);
}

std::uint64_t hash_of_pair(std::uint32_t first, std::uint32_t second)
{
    std::uint64_t hash = std::uint64_t{std::min(first, second)} << 32 | std::max(first, second);
    for (int round = 0; round < 2; ++round)
    {
        hash = (hash + 1) * 0x9e3779b97f4a7c15ULL;
        hash ^= hash >> 29;
    }
    return hash;
}
} // namespace ode_predictive_space::recording
