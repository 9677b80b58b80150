#include "demos/scenes/spaces.h"

#include <algorithm>
#include <cmath>
#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>

namespace ode_predictive_space::scenes
{
namespace
{
dSpaceID make_quadtree(const SceneFactory &factory)
{
    const SceneBounds bounds = factory.bounds();
    const dVector3 centre = {bounds.centre.x(), bounds.centre.y(), bounds.centre.z()};
    const dVector3 half_extent = {bounds.half_extent.x(), bounds.half_extent.y(), bounds.half_extent.z()};
    // About one object per leaf, which was the fastest of the depths tried.
    const double levels = std::log(factory.spec().objects) / std::log(4.0);
    const int depth = std::clamp(static_cast<int>(std::lround(levels)), 1, 8);
    return dQuadTreeSpaceCreate(nullptr, centre, half_extent, depth);
}

dSpaceID try_to_make_space(SpaceKind kind, const SceneFactory &factory)
{
    switch (kind)
    {
    case SpaceKind::simple:
        return dSimpleSpaceCreate(nullptr);
    case SpaceKind::hash:
        return dHashSpaceCreate(nullptr);
    case SpaceKind::quadtree:
        return make_quadtree(factory);
    case SpaceKind::sweep_and_prune:
        return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
    case SpaceKind::predictive:
        break;
    }
    return dPredictiveSpaceCreate(nullptr);
}
} // namespace

const std::vector<SpaceKind> &all_spaces()
{
    static const std::vector<SpaceKind> kinds = {SpaceKind::predictive, SpaceKind::simple, SpaceKind::hash,
                                                 SpaceKind::quadtree, SpaceKind::sweep_and_prune};
    return kinds;
}

std::string space_name(SpaceKind kind)
{
    switch (kind)
    {
    case SpaceKind::simple:
        return "simple";
    case SpaceKind::hash:
        return "hash";
    case SpaceKind::quadtree:
        return "quadtree";
    case SpaceKind::sweep_and_prune:
        return "sap";
    case SpaceKind::predictive:
        break;
    }
    return "predictive";
}

SpaceKind space_named(const std::string &name)
{
    for (const SpaceKind kind : all_spaces())
    {
        if (space_name(kind) == name)
        {
            return kind;
        }
    }
    throw std::invalid_argument("there is no space named \"" + name + "\"");
}

dSpaceID make_space(SpaceKind kind, const SceneFactory &factory)
{
    const dSpaceID space = try_to_make_space(kind, factory);
    if (space == nullptr)
    {
        throw std::runtime_error("ODE could not make a " + space_name(kind) + " space");
    }
    return space;
}

OdeSession::OdeSession()
{
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
}

OdeSession::~OdeSession()
{
    dCloseODE();
}
} // namespace ode_predictive_space::scenes
