#include "ode_predictive_space/broadphase/near/shape_test.h"

#include <limits>

#include "ode_predictive_space/broadphase/shape/gap.h"
#include "ode_predictive_space/broadphase/shape/surface_gap.h"

namespace ode_predictive_space
{
namespace
{
// Part of the smaller size of two objects: so far apart, programs may find contacts, because they compute with tolerances.
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

// Have the shapes no gap larger than the margin, because the balls within them have none? In piles most pairs are told so.
bool touch_within(const ConvexShape &first, const ConvexShape &second, double margin)
{
    const auto has_ball = [](const ConvexShape &shape) {
        return shape.kind == ShapeKind::rounded || shape.kind == ShapeKind::cylinder;
    };
    const double reach = 0.5 * (first.size + second.size) + margin;
    return has_ball(first) && has_ball(second) && (second.centre - first.centre).squaredNorm() <= reach * reach;
}

// Is a hull of no use there? Terrain has none.
bool is_within_hull(const Vector3 &point, const ConvexShape &mesh)
{
    return mesh.kind == ShapeKind::terrain ||
           (mesh.along_axes(point - mesh.centre).cwiseAbs().array() <= mesh.half_sides.array()).all();
}

// The end of a postponement. A few short ones come before each contact; when there is no end of them, looks cost more than they save.
void note_postponement(Look &look, std::uint8_t report)
{
    const bool was_short = static_cast<std::uint8_t>(report - look.since) < tuning::least_wait;
    look.hasty =
        was_short ? static_cast<std::uint8_t>(std::min(look.hasty + 1, tuning::most_short_waits)) : std::uint8_t{0};
    look.last_pause = was_short ? look.last_pause : std::uint8_t{0};
    look.due = 0;
}

void pause(Look &look)
{
    look.last_pause = static_cast<std::uint8_t>(std::clamp(2 * look.last_pause, 2, tuning::longest_pause));
    look.pause = static_cast<std::uint8_t>(look.last_pause - 1);
}
} // namespace

double touching_distance(const ConvexShape &first, const ConvexShape &second, double margin)
{
    return margin + contact_slack * std::min(first.size, second.size) + slack(first, second);
}

// To the hulls, and where these have none, to the surface of one. A shape whose centre is in the box of a mesh is most likely in its
// hull, too.
Gap ShapeTest::gap_between(const CandidatePair &pair, const Look &look, double margin)
{
    const ConvexShape &first = shapes()[pair.first], &second = shapes()[pair.second];
    const ConvexShape *surface = surface_of(first, second);
    Gap gap;
    if (!surface || !is_within_hull(surface == &first ? second.centre : first.centre, *surface))
        gap = find_gap(first, second, Vector3(look.axis[0], look.axis[1], look.axis[2]), margin);
    if (!surface || gap.length > margin)
        return gap;
    if (objects_.shapes.build(surface == &first ? pair.first : pair.second))
        gap.improve({surface_gap(first, second, margin), Vector3::Zero()});
    return gap;
}

// Of a convex or mesh contacts are dear to find, and of what a person holds the program asks for more than contacts.
bool ShapeTest::pays_always(const CandidatePair &pair) const
{
    const std::vector<ProxyRecord> &records = objects_.proxies.records;
    return shapes()[pair.first].hull || shapes()[pair.second].hull || is_interactive(records[pair.first].role) ||
           is_interactive(records[pair.second].role);
}

bool ShapeTest::looks_near(const CandidatePair &pair, Look &look, std::uint8_t report)
{
    const ConvexShape &first = shapes()[pair.first], &second = shapes()[pair.second];
    const double margin = touching_distance(first, second, margin_);
    const bool was_postponed = look.due > 0;
    if (was_postponed)
        note_postponement(look, report);
    const bool in_vain = was_postponed && look.hasty == tuning::most_short_waits && !pays_always(pair);
    if (in_vain || touch_within(first, second, margin))
    {
        pause(look);
        return true;
    }
    ++looks_;
    const Gap gap = gap_between(pair, look, margin);
    for (Eigen::Index i = 0; i < 3; ++i)
        look.axis[i] = static_cast<float>(gap.axis[i]);
    if (!(gap.length > margin))
    {
        pause(look);
        if (const ConvexShape *surface = surface_of(first, second); surface && !surface->surface()->is_ready())
            look.pause = tuning::pause_while_built;
        return true;
    }
    constexpr double rounds_down = 1 - 8 * std::numeric_limits<double>::epsilon();
    look.due = rounds_down * (shapes().travel(pair) + (gap.length - margin));
    look.since = report;
    return false;
}
} // namespace ode_predictive_space
