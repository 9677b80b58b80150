#include "demos/worlds/spaces.h"

#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>

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

dSpaceID make_predictive(int proximity)
{
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    if (space == nullptr)
        throw std::runtime_error("the predictive space could not be made");
    dPredictiveSpaceSetProximity(space, proximity);
    return space;
}
} // namespace

const std::vector<std::string> &exact_spaces()
{
    static const std::vector<std::string> names = {"predictive-box", "simple", "hash", "quadtree", "sap"};
    return names;
}

const std::vector<std::string> &all_spaces()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = exact_spaces();
        all.insert(all.end(), {"predictive-sphere", "predictive-shape"});
        return all;
    }();
    return names;
}

dSpaceID make_space(const std::string &name, const WorldFactory &factory)
{
    if (name == "simple")
        return dSimpleSpaceCreate(nullptr);
    if (name == "hash")
        return dHashSpaceCreate(nullptr);
    if (name == "quadtree")
        return make_quadtree(factory);
    if (name == "sap")
        return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
    if (name == "predictive-sphere")
        return make_predictive(dPredictiveProximitySphere);
    if (name == "predictive-shape")
        return make_predictive(dPredictiveProximityShape);
    if (name == "predictive-box")
        return make_predictive(dPredictiveProximityBox);
    throw std::invalid_argument("there is no space named \"" + name + "\"");
}

OdeSession::OdeSession()
{
    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
}
} // namespace ode_predictive_space::worlds
