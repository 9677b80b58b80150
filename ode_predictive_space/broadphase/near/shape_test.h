// The shape test. In: near pairs. Out: whether their shapes may touch. Pairs are postponed until their gap can have closed.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SHAPE_TEST_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_SHAPE_TEST_H

#include <cstdint>

#include "ode_predictive_space/broadphase/near/gap_budget.h"
#include "ode_predictive_space/broadphase/near/overlap_test.h"
#include "ode_predictive_space/broadphase/objects/measured_shapes.h"
#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
enum class Payer : std::uint8_t
{
    first,
    second,
    none ///< the program has made an object of the pair interactive: checks are not limited
};

/// The result of a pair's last gap check, and the time of the next one. A new pair is due at its first test.
struct GapCache
{
    explicit GapCache(Payer pays) : payer(pays) {}

    double due = 0;         ///< sum of both travels up to which the pair is postponed; 0 if it is not
    float axis[3] = {};     ///< the last check's axis, from the first object to the second
    std::uint8_t pause = 0; ///< reports until the next check, after checks that found no gap
    std::uint8_t last_pause = 0;
    bool is_excluded = false; ///< a filter excluded the pair when a check was last due
    Payer payer;

    /// @return null if checks are not limited.
    const ProxyId *payer_of(const CandidatePair &pair) const
    {
        return payer == Payer::none ? nullptr : payer == Payer::first ? &pair.first : &pair.second;
    }
};
static_assert(sizeof(GapCache) == 24, "there is one for each near pair that is tested by shape");

/// Doubles the pause before the next check, up to tuning::reports_per_rest.
void wait_longer(GapCache &cache);

/// The distance up to which a pair counts as touching. @param margin the program's part of it.
double touching_distance(const ConvexShape &first, const ConvexShape &second, double margin);

/// False if a gap exceeds the touching distance.
bool shapes_may_touch(const ConvexShape &first, const ConvexShape &second, double margin);

struct ShapeTest
{
    const OverlapTest &boxes;
    const ProxyStore &proxies;
    MeasuredShapes &shapes;
    double margin;
    std::uint64_t &checks; ///< counts gap checks

    void follow(const IdSet &wanted) { shapes.update(boxes.scene, wanted, proxies); }

    /// Whether the gap cannot have closed since the last check. @pre if that check found a gap, follow() of both objects.
    bool postpones(const CandidatePair &pair, const GapCache &cache) const { return shapes.travel(pair) < cache.due; }

    GapCache new_gap_cache(const CandidatePair &pair) const;

    /// Checks a gap and decides when the next check is due. @pre follow() of both. @return whether the shapes may touch.
    bool check_gap(const CandidatePair &pair, GapCache &cache, GapBudget &budget);
};
} // namespace ode_predictive_space

#endif
