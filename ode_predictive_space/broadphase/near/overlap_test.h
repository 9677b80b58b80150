// Do two objects overlap now? In single precision first; exactly only where that is too close to tell.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_OVERLAP_TEST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_OVERLAP_TEST_H

#include <limits>

#include "ode_predictive_space/broadphase/objects/scene.h"

namespace ode_predictive_space
{
/// @pre the tight boxes of all objects that are tested are up to date.
struct OverlapTest
{
    Scene &scene;
    const Place *places;
    bool by_sphere; ///< bounding spheres must overlap, too
    Float4 certain; ///< boxes that overlap by more do so in double precision, too, wherever in the scene they are

    bool operator()(const CandidatePair &pair) const
    {
        const Place &first = places[pair.first], &second = places[pair.second];
        if (surely_apart(first, second))
            return false;
        const Float4 depths = overlap_depths(first, second), most = Float4::all(std::numeric_limits<float>::max());
        const bool overlap = (((depths > certain) & (depths <= most)).bits() & three_lanes) == three_lanes;
        return (overlap && !by_sphere) || overlap_closely(pair);
    }

private:
    bool overlap_closely(const CandidatePair &pair) const
    {
        return (!by_sphere && surely_overlap(places[pair.first], places[pair.second])) ||
               scene.overlap(pair.first, pair.second);
    }
};
} // namespace ode_predictive_space

#endif
