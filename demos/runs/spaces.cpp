#include "demos/runs/spaces.h"

#include <algorithm>
#include <cmath>
#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>
#include <utility>

namespace ode_predictive_space::worlds
{
namespace
{
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

dSpaceID try_to_make_space(SpaceKind kind, const WorldFactory &factory)
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
    case SpaceKind::predictive_by_spheres:
    case SpaceKind::predictive_by_shapes:
        break;
    }
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    if (space != nullptr && kind == SpaceKind::predictive_by_spheres)
        dPredictiveSpaceSetProximity(space, dPredictiveProximitySphere);
    if (space != nullptr && kind == SpaceKind::predictive_by_shapes)
        dPredictiveSpaceSetProximity(space, dPredictiveProximityShape);
    return space;
}

Family family_of(SpaceKind kind)
{
    return is_predictive(kind) ? Family::predictive : Family::ode;
}

class SpaceContender : public Contender
{
public:
    SpaceContender(SpaceKind kind, OwnedSpace space)
        : Contender(space_name(kind), family_of(kind), std::move(space)), kind_(kind)
    {}

    bool exact() const override
    {
        return kind_ != SpaceKind::predictive_by_spheres && kind_ != SpaceKind::predictive_by_shapes;
    }

    // The sweep-and-prune space rounds its first axis to single precision: it reports pairs with a gap in the eighth digit.
    std::size_t finish(PairList &list) override
    {
        return kind_ == SpaceKind::sweep_and_prune ? list.drop_pairs_apart() : 0;
    }

private:
    SpaceKind kind_;
};
} // namespace

bool is_predictive(SpaceKind kind)
{
    return kind == SpaceKind::predictive || kind == SpaceKind::predictive_by_spheres ||
           kind == SpaceKind::predictive_by_shapes;
}

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
    case SpaceKind::predictive_by_spheres:
        return "predictive-sphere";
    case SpaceKind::predictive_by_shapes:
        return "predictive-shape";
    case SpaceKind::predictive:
        break;
    }
    return "predictive-box";
}

SpaceKind space_named(const std::string &name)
{
    if (name == "predictive")
        return SpaceKind::predictive;
    for (const SpaceKind kind :
         {SpaceKind::predictive, SpaceKind::predictive_by_spheres, SpaceKind::predictive_by_shapes, SpaceKind::simple,
          SpaceKind::hash, SpaceKind::quadtree, SpaceKind::sweep_and_prune})
    {
        if (space_name(kind) == name)
            return kind;
    }
    throw std::invalid_argument("there is no space named \"" + name + "\"");
}

dSpaceID make_space(SpaceKind kind, const WorldFactory &factory)
{
    const dSpaceID space = try_to_make_space(kind, factory);
    if (space == nullptr)
        throw std::runtime_error("ODE could not make a " + space_name(kind) + " space");
    return space;
}

std::unique_ptr<Contender> make_contender(SpaceKind kind, const WorldFactory &factory)
{
    return make_contender(kind, OwnedSpace(make_space(kind, factory)));
}

std::unique_ptr<Contender> make_contender(SpaceKind kind, OwnedSpace space)
{
    return std::make_unique<SpaceContender>(kind, std::move(space));
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
} // namespace ode_predictive_space::worlds
