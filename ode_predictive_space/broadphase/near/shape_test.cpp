#include "ode_predictive_space/broadphase/near/shape_test.h"

#include <limits>

#include "ode_predictive_space/broadphase/shape/gap.h"

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

void pause(Look &look)
{
    look.due = 0;
    look.last_pause = static_cast<std::uint8_t>(std::clamp(2 * look.last_pause, 2, tuning::longest_pause));
    look.pause = static_cast<std::uint8_t>(look.last_pause - 1);
}
} // namespace

double touching_distance(const ConvexShape &first, const ConvexShape &second, double margin)
{
    return margin + contact_slack * std::min(first.size, second.size) + slack(first, second);
}

bool ShapeTest::may_touch(const CandidatePair &pair, Look &look)
{
    const ConvexShape &first = shapes()[pair.first], &second = shapes()[pair.second];
    const double margin = touching_distance(first, second, margin_);
    if (touch_within(first, second, margin))
    {
        pause(look);
        return true;
    }
    ++looks_;
    const Vector3 axis(look.axis[0], look.axis[1], look.axis[2]);
    const Gap gap = find_gap(first, second, axis, margin);
    for (Eigen::Index i = 0; i < 3; ++i)
        look.axis[i] = static_cast<float>(gap.axis[i]);
    if (gap.length > margin)
    {
        constexpr double rounds_down = 1 - 8 * std::numeric_limits<double>::epsilon();
        look.due = rounds_down * (shapes().travel(pair) + (gap.length - margin));
        look.last_pause = 0;
        return false;
    }
    pause(look);
    return true;
}
} // namespace ode_predictive_space
