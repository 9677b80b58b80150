// The overlap test: in single precision first, exactly only if that is too close to decide.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_OVERLAP_TEST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_OVERLAP_TEST_H

#include <limits>
#include <vector>

#include "ode_predictive_space/broadphase/objects/scene.h"

namespace ode_predictive_space
{
/// @pre the tight boxes of all tested objects are up to date.
struct OverlapTest
{
    Scene &scene;
    Place *places;
    bool by_sphere; ///< bounding spheres must overlap, too
    Float4 doubt;   ///< Origin::doubt()
    Float4 certain; ///< tight boxes that overlap by more overlap for certain, anywhere; infinite by sphere

    bool operator()(const CandidatePair &pair) const
    {
        const Rough rough = roughly(pair);
        return rough.is_doubtful() ? overlap_closely(pair) : rough.overlap;
    }

    /// Copies the pairs that overlap. The copy is branch-free, as overlap cannot be predicted.
    CandidatePair *copy_overlapping(const std::vector<CandidatePair> &pairs, CandidatePair *end) const
    {
        for (const CandidatePair &pair : pairs)
        {
            const Rough rough = roughly(pair);
            *end = pair;
            end += rough.is_doubtful() ? overlap_closely(pair) : rough.overlap;
        }
        return end;
    }

private:
    // Results that are certain in single precision. At most one is true.
    struct Rough
    {
        bool apart, overlap;
        bool is_doubtful() const { return apart == overlap; }
    };

    Rough roughly(const CandidatePair &pair) const
    {
        const Place &first = places[pair.first], &second = places[pair.second];
        const Float4 depths = overlap_depths(first, second), most = Float4::all(std::numeric_limits<float>::max());
        const Mask4 surely = (depths > certain) & (depths <= most);
        return {surely_apart(first, second), (surely.bits() & three_lanes) == three_lanes};
    }

    bool overlap_closely(const CandidatePair &pair) const
    {
        return (!by_sphere && surely_overlap(places[pair.first], places[pair.second], doubt)) ||
               scene.overlap(pair.first, pair.second);
    }
};
} // namespace ode_predictive_space

#endif
