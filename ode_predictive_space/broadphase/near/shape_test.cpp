#include "ode_predictive_space/broadphase/near/shape_test.h"

#include <algorithm>
#include <limits>

#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/shape/surface_gap.h"

namespace ode_predictive_space
{
namespace
{
// Distance at which colliders with tolerances may find contacts, as a part of the smaller object's size.
constexpr double contact_slack = 1e-3;

double slack(const ConvexShape &first, const ConvexShape &second)
{
    const bool beside_half_space = first.kind == ShapeKind::half_space || second.kind == ShapeKind::half_space;
    double of_sizes = first.slack + second.slack;
    if (first.group == second.group)
        of_sizes += first.slack_beside_own + second.slack_beside_own;
    if (!beside_half_space)
        of_sizes *= first.sliver_factor * second.sliver_factor;
    return of_sizes + first.place_slack + second.place_slack;
}

// Whether inscribed balls prove that no gap exceeds the margin. This decides most pairs in piles.
bool touch_within(const ConvexShape &first, const ConvexShape &second, double margin)
{
    const auto has_ball = [](const ConvexShape &shape) {
        return shape.kind == ShapeKind::rounded || shape.kind == ShapeKind::cylinder;
    };
    const double reach = 0.5 * (first.size + second.size) + margin;
    return has_ball(first) && has_ball(second) && (second.centre - first.centre).squaredNorm() <= reach * reach;
}

// Whether a shape at this point is most likely inside the mesh's hull, which then proves no gap. Terrain has no hull.
bool is_within_hull(const Vector3 &point, const ConvexShape &mesh)
{
    return mesh.kind == ShapeKind::terrain ||
           (mesh.along_axes(point - mesh.centre).cwiseAbs().array() <= mesh.half_sides.array()).all();
}

// The gap between the hulls; without one, the gap to a surface. A shape inside a mesh's hull skips the first search.
Gap gap_between(const ConvexShape &first, const ConvexShape &second, const GapCache &cache, double margin)
{
    const ConvexShape *surface = surface_of(first, second);
    Gap gap;
    if (!surface || !is_within_hull(surface == &first ? second.centre : first.centre, *surface))
        gap = find_gap(first, second, Vector3(cache.axis[0], cache.axis[1], cache.axis[2]), margin);
    if (!surface || gap.length > margin)
        return gap;
    gap.improve(surface_gap(first, second, margin));
    return gap;
}
} // namespace

void wait_longer(GapCache &cache)
{
    cache.last_pause = static_cast<std::uint8_t>(std::clamp(2u * cache.last_pause, 2u, tuning::reports_per_rest));
    cache.pause = static_cast<std::uint8_t>(cache.last_pause - 1);
}

double touching_distance(const ConvexShape &first, const ConvexShape &second, double margin)
{
    return margin + contact_slack * std::min(first.size, second.size) + slack(first, second);
}

bool shapes_may_touch(const ConvexShape &first, const ConvexShape &second, double margin)
{
    const double distance = touching_distance(first, second, margin);
    return !(find_gap(first, second, Vector3::Zero(), distance).length > distance ||
             surface_gap(first, second, distance).length > distance);
}

GapCache ShapeTest::new_gap_cache(const CandidatePair &pair) const
{
    const std::vector<ProxyRecord> &records = proxies.records;
    const auto is_hand = [&](ProxyId id) { return records[id].role == Role::fixed_interactive; };
    if (is_hand(pair.first) || is_hand(pair.second))
        return GapCache(Payer::none);
    return GapCache(records[pair.first].is_costly ? Payer::first : Payer::second);
}

bool ShapeTest::check_gap(const CandidatePair &pair, GapCache &cache, GapBudget &budget)
{
    const ConvexShape &first = shapes[pair.first], &second = shapes[pair.second];
    if (cache.due > 0)
        cache.last_pause = 0;
    cache.due = 0;
    const double reach = touching_distance(first, second, margin);
    if (touch_within(first, second, reach))
    {
        wait_longer(cache);
        return true;
    }
    ++checks;
    const Gap gap = gap_between(first, second, cache, reach);
    if (const ProxyId *payer = cache.payer_of(pair))
        budget.note_check(*payer, gap.work);
    for (Eigen::Index i = 0; i < 3; ++i)
        cache.axis[i] = static_cast<float>(gap.axis[i]);
    if (!(gap.length > reach))
    {
        wait_longer(cache);
        return true;
    }
    constexpr double rounds_down = 1 - 8 * std::numeric_limits<double>::epsilon();
    cache.due = rounds_down * (shapes.travel(pair) + (gap.length - reach));
    return false;
}
} // namespace ode_predictive_space
