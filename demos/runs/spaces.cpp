#include "demos/runs/spaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr std::array names = {
    "predictive-box", "predictive-sphere", "predictive-shape", "simple", "hash", "quadtree", "sap"};

dSpaceID make_quadtree(const WorldFactory &factory)
{
    const Bounds bounds = factory.bounds();
    const dVector3 centre = {bounds.centre.x(), bounds.centre.y(), bounds.centre.z()};
    const dVector3 half_extent = {bounds.half_extent.x(), bounds.half_extent.y(), bounds.half_extent.z()};
    // About one object per leaf, which was the fastest of the depths tried.
    const double levels = std::log(factory.spec().objects) / std::log(4.0);
    const int depth = std::clamp(static_cast<int>(std::lround(levels)), 1, 8);
    return dQuadTreeSpaceCreate(nullptr, centre, half_extent, depth);
}

dSpaceID make_predictive(int proximity)
{
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    if (space == nullptr)
        throw std::runtime_error("the predictive space could not be made");
    dPredictiveSpaceSetProximity(space, proximity);
    return space;
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
    return names.at(static_cast<std::size_t>(kind));
}

SpaceKind space_named(const std::string &name)
{
    const auto found = std::find(names.begin(), names.end(), name == "predictive" ? "predictive-box" : name);
    if (found == names.end())
        throw std::invalid_argument("there is no space named \"" + name + "\"");
    return static_cast<SpaceKind>(found - names.begin());
}

dSpaceID make_space(SpaceKind kind, const WorldFactory &factory)
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
    case SpaceKind::predictive_by_spheres:
        return make_predictive(dPredictiveProximitySphere);
    case SpaceKind::predictive_by_shapes:
        return make_predictive(dPredictiveProximityShape);
    case SpaceKind::predictive:
        break;
    }
    return make_predictive(dPredictiveProximityBox);
}

std::unique_ptr<Contender> make_contender(SpaceKind kind, const WorldFactory &factory)
{
    return std::make_unique<Contender>(space_name(kind), OwnedSpace(make_space(kind, factory)));
}

OdeSession::OdeSession()
{
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
}
} // namespace ode_predictive_space::worlds
