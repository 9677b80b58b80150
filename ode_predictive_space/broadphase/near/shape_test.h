// Can the shapes of two objects touch now? A pair is postponed for as long as its gap cannot have closed.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SHAPE_TEST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SHAPE_TEST_H

#include <algorithm>
#include <cstdint>

#include "ode_predictive_space/broadphase/near/overlap_test.h"
#include "ode_predictive_space/broadphase/objects/measured_shapes.h"
#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
/// What is known of the gap of a near pair. A new pair is looked at when it is first tested.
struct Look
{
    double due = 0; ///< the pair is postponed until the travels of both objects together reach this; 0 when it is not
    float axis[3] = {};     ///< of the last look, from the first object to the second
    std::uint8_t pause = 0; ///< reports until the next look, of a pair whose looks are in vain
    std::uint8_t last_pause = 0;
};
static_assert(sizeof(Look) == 24, "there is one for each near pair");

/// Up to this distance a pair counts as touching. @param margin what the program adds.
double touching_distance(const ConvexShape &first, const ConvexShape &second, double margin);

/// Is there no gap of more than the touching distance?
bool shapes_may_touch(const ConvexShape &first, const ConvexShape &second, double margin);

/// Looks at travels and gaps, each when it is needed.
class ShapeTest
{
public:
    /// The objects, and what is known of them.
    struct Objects
    {
        Scene &scene;
        const ProxyStore &proxies;
        MeasuredShapes &shapes;
    };

    /// @param boxes whether bounding boxes overlap.
    /// @param margin up to this distance the program counts a pair as touching.
    /// @param looks counts the looks at a gap.
    ShapeTest(const Objects &objects, const OverlapTest &boxes, double margin, std::uint64_t &looks)
        : objects_(objects), boxes_(boxes), margin_(margin), looks_(looks)
    {}

    /// Brings shapes and travels up to date.
    void follow(const IdSet &wanted) { objects_.shapes.update(objects_.scene, wanted, objects_.proxies); }
    /// The same for hulls that no longer serve.
    void renew_outdated(const IdSet &wanted)
    {
        objects_.shapes.renew_outdated(objects_.scene, wanted, objects_.proxies.members());
    }
    /// Goes on building the tree of a mesh that a look has needed.
    void build() { objects_.shapes.build(objects_.scene); }
    /// Nothing need be known of the shapes of other objects.
    void keep_only(const IdSet &wanted) { objects_.shapes.keep_only(wanted); }

    /// Can the gap not have closed since the last look? The pair's shapes are up to date, if it has had one that found a gap.
    bool postpones(const CandidatePair &pair, const Look &look) const
    {
        return objects_.shapes.travel(pair) < look.due;
    }

    /// Whether bounding boxes overlap.
    const OverlapTest &boxes() const { return boxes_; }

    /// Looks at the gap of the pair, whose shapes are up to date, and decides when the next look is due.
    bool looks_near(const CandidatePair &pair, Look &look);

    const MeasuredShapes &shapes() const { return objects_.shapes; }

private:
    Gap gap_between(const CandidatePair &pair, const Look &look, double margin);

    Objects objects_;
    OverlapTest boxes_;
    double margin_;
    std::uint64_t &looks_;
};
} // namespace ode_predictive_space

#endif
