#include "ode_predictive_space/recording/space_kind.h"

#include <ode/collision.h>

#include "ode_predictive_space/predictive_space.h"

namespace ode_predictive_space::recording
{
const char *name_of(SpaceKind kind)
{
    constexpr const char *names[] = {"own", "simple", "hash", "quadtree", "sap", "box", "sphere", "shape", "none"};
    return names[static_cast<std::size_t>(kind)];
}

SpaceKind predictive_kind(int proximity)
{
    switch (proximity)
    {
    case dPredictiveProximitySphere:
        return SpaceKind::sphere;
    case dPredictiveProximityShape:
        return SpaceKind::shape;
    default:
        return SpaceKind::box;
    }
}

SpaceKind own_kind(const GeomState &space)
{
    if (space.service.is_predictive_in_program())
        return predictive_kind(space.service.predictive - 1);
    switch (space.geom_class)
    {
    case dSimpleSpaceClass:
        return SpaceKind::simple;
    case dQuadTreeSpaceClass:
        return SpaceKind::quadtree;
    case dSweepAndPruneSpaceClass:
        return SpaceKind::sap;
    default:
        return SpaceKind::hash;
    }
}

SpaceKind recorded_kind(const GeomState &space)
{
    return space.service.predictive ? predictive_kind(space.service.predictive - 1) : own_kind(space);
}

bool is_predictive(SpaceKind kind)
{
    return kind == SpaceKind::box || leaves_out_pairs(kind);
}

std::string full_name_of(SpaceKind kind)
{
    return is_predictive(kind) ? std::string("predictive, by ") + name_of(kind) : name_of(kind);
}

std::optional<SpaceKind> kind_named(const std::string &name)
{
    for (const SpaceKind kind : all_kinds)
        if (name == name_of(kind))
            return kind;
    return std::nullopt;
}

bool leaves_out_pairs(SpaceKind kind)
{
    return kind == SpaceKind::sphere || kind == SpaceKind::shape;
}
} // namespace ode_predictive_space::recording
