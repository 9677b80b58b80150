// Can the shapes of two objects touch now? A pair is postponed for as long as its gap cannot have closed.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SHAPE_TEST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SHAPE_TEST_H

#include <algorithm>
#include <cstdint>

#include "ode_predictive_space/broadphase/near/overlap_test.h"
#include "ode_predictive_space/broadphase/objects/measured_shapes.h"
#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
/// What is known of the gap of a near pair. A new pair is looked at when it is first tested.
struct Look
{
    double due = 0;         ///< the pair is postponed until the travels of both objects together reach this
    float axis[3] = {};     ///< of the last look, from the first object to the second
    std::uint8_t pause = 0; ///< reports until the next look, of a pair without a gap
    std::uint8_t last_pause = 0;
};
static_assert(sizeof(Look) == 24, "there is one for each near pair");

/// @pre boxes and shapes of all objects that are tested are up to date.
class ShapeTest
{
public:
    /// @param margin up to this distance the program counts a pair as touching.
    /// @param looks counts the looks at a gap.
    ShapeTest(const OverlapTest &boxes, const MeasuredShapes &shapes, double margin, std::uint64_t &looks)
        : boxes_(boxes), shapes_(shapes), margin_(margin), looks_(looks)
    {}

    /// Is the pair to be reported? One without a gap is, until it is looked at again.
    bool operator()(const CandidatePair &pair, Look &look) const
    {
        if (shapes_.travel(pair) < look.due || !boxes_(pair))
            return false;
        if (look.pause == 0)
            return may_touch(pair, look);
        --look.pause;
        return true;
    }

    /// The same, looking at the gap now.
    bool judge(const CandidatePair &pair, Look &look) const
    {
        return shapes_.travel(pair) >= look.due && boxes_(pair) && may_touch(pair, look);
    }

    const MeasuredShapes &shapes() const { return shapes_; }

private:
    // Not inlined: few pairs come so far.
    [[gnu::noinline]] bool may_touch(const CandidatePair &pair, Look &look) const;

    OverlapTest boxes_;
    const MeasuredShapes &shapes_;
    double margin_;
    std::uint64_t &looks_;
};
} // namespace ode_predictive_space

#endif
