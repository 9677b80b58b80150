// Can the shapes of two objects touch now? A pair is postponed for as long as its gap cannot have closed.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SHAPE_TEST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SHAPE_TEST_H

#include <algorithm>
#include <cstdint>

#include "ode_predictive_space/broadphase/near/gap_budget.h"
#include "ode_predictive_space/broadphase/near/overlap_test.h"
#include "ode_predictive_space/broadphase/objects/measured_shapes.h"
#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
/// From which account the looks at a pair are drawn.
enum class Payer : std::uint8_t
{
    first, ///< object of the pair
    second,
    nobody ///< the program has made one of the two interactive, and wants few calls for it at any cost
};

/// What is known of the gap of a near pair. A new pair is looked at when it is first tested.
struct GapCache
{
    explicit GapCache(Payer pays) : payer(pays) {}

    double due = 0; ///< the pair is postponed until the travels of both objects together reach this; 0 when it is not
    float axis[3] = {};     ///< of the last look, from the first object to the second
    std::uint8_t pause = 0; ///< reports until the next look, of a pair whose looks are in vain
    std::uint8_t last_pause = 0;
    bool is_excluded = false; ///< when a look was last due, the program was not to be called for the pair
    Payer payer;

    /// @return null when the looks are drawn from no account.
    const ProxyId *payer_of(const CandidatePair &pair) const
    {
        return payer == Payer::nobody ? nullptr : payer == Payer::first ? &pair.first : &pair.second;
    }
};
static_assert(sizeof(GapCache) == 24, "there is one for each near pair that is tested by shape");

/// The next look is due after some reports, twice as many as before.
void wait_longer(GapCache &cache);

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
    /// @param checks counts the gap checks.
    ShapeTest(const Objects &objects, const OverlapTest &boxes, double margin, std::uint64_t &checks)
        : objects_(objects), boxes_(boxes), margin_(margin), checks_(checks)
    {}

    /// Brings shapes and travels up to date.
    void follow(const IdSet &wanted) { objects_.shapes.update(objects_.scene, wanted, objects_.proxies); }
    /// Nothing need be known of the shapes of other objects.
    void keep_only(const IdSet &wanted) { objects_.shapes.keep_only(wanted); }

    /// Can the gap not have closed since the last look? The pair's shapes are up to date, if it has had one that found a gap.
    bool postpones(const CandidatePair &pair, const GapCache &cache) const
    {
        return objects_.shapes.travel(pair) < cache.due;
    }

    /// Whether bounding boxes overlap.
    const OverlapTest &boxes() const { return boxes_; }

    /// Would the program not be called for the pair even if it touched? That may change without notice.
    bool is_excluded(const CandidatePair &pair) const { return objects_.scene.is_excluded(pair.first, pair.second); }

    /// Of a pair that is new, or as good as new.
    GapCache new_gap_cache(const CandidatePair &pair) const;

    /// Looks at the gap of the pair, whose shapes are up to date, and decides when the next look is due.
    bool check_gap(const CandidatePair &pair, GapCache &cache, GapBudget &budget);

    const MeasuredShapes &shapes() const { return objects_.shapes; }

private:
    Gap gap_between(const CandidatePair &pair, const GapCache &cache, double margin);

    Objects objects_;
    OverlapTest boxes_;
    double margin_;
    std::uint64_t &checks_;
};
} // namespace ode_predictive_space

#endif
