// Do two objects overlap now? In single precision first; exactly only where that is too close to tell.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_OVERLAP_TEST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_OVERLAP_TEST_H

#include <vector>

#include "ode_predictive_space/broadphase/objects/measured_boxes.h"

namespace ode_predictive_space
{
/// @pre the boxes of all objects that are tested are up to date.
struct OverlapTest
{
    Scene &scene;
    const MeasuredBox *boxes;
    bool by_sphere; ///< bounding spheres must overlap, too

    bool operator()(const CandidatePair &pair) const
    {
        const Comparison compared = compare(boxes[pair.first], boxes[pair.second]);
        if (compared.unsure() || (by_sphere && compared.overlap()))
            return scene.overlap(pair.first, pair.second);
        return compared.overlap();
    }
};

/// Collects the pairs that overlap. Which they are is as good as random: store always, advance on a hit (branch-free).
class OverlapCollector
{
public:
    /// @param room has room for all pairs that will be tested.
    OverlapCollector(const OverlapTest &test, CandidatePair *room) : test_(test), end_(room) {}

    void operator()(const CandidatePair &pair)
    {
        const bool overlaps = test_(pair);
        *end_ = pair;
        end_ += overlaps;
    }

    CandidatePair *end() const { return end_; }

private:
    OverlapTest test_;
    CandidatePair *end_;
};
} // namespace ode_predictive_space

#endif
