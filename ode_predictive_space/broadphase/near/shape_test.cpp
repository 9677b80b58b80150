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
    const double slack = first.slack + first.place_slack + second.slack + second.place_slack;
    return first.group == second.group ? slack + first.slack_beside_own + second.slack_beside_own : slack;
}
} // namespace

bool ShapeTest::may_touch(const CandidatePair &pair, Look &look)
{
    ++looks_;
    const ConvexShape &first = shapes()[pair.first], &second = shapes()[pair.second];
    const double margin = margin_ + contact_slack * std::min(first.size, second.size) + slack(first, second);
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
    look.due = 0;
    look.last_pause = static_cast<std::uint8_t>(std::clamp(2 * look.last_pause, 2, tuning::longest_pause));
    look.pause = static_cast<std::uint8_t>(look.last_pause - 1);
    return true;
}
} // namespace ode_predictive_space
