#include "ode_predictive_space/broadphase/predict/extent.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_predictive_space
{
namespace
{
double finite_or(double value, double otherwise)
{
    return std::isfinite(value) ? value : otherwise;
}

Vector3 finite_centre(const Box &box)
{
    Vector3 centre;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double low = finite_or(box.min()[axis], box.max()[axis]);
        centre[axis] = finite_or(0.5 * (low + finite_or(box.max()[axis], low)), 0);
    }
    return centre;
}

// The box relative to the centre. Rounding must not make it smaller: neither here nor when it is put back in its place.
Box relative_to(const Vector3 &centre, const Box &box)
{
    const double unit = 4 * std::numeric_limits<double>::epsilon();
    const Vector3 below = unit * (centre.cwiseAbs() + box.min().cwiseAbs());
    const Vector3 above = unit * (centre.cwiseAbs() + box.max().cwiseAbs());
    return Box(box.min() - centre - below, box.max() - centre + above);
}

// Distance from the centre, which the box is relative to.
double farthest_corner(const FloatBox &box)
{
    return Vector3(std::max(-box.low[0], box.high[0]), std::max(-box.low[1], box.high[1]),
                   std::max(-box.low[2], box.high[2]))
        .norm();
}

Box cube(double half)
{
    return Box(Vector3::Constant(-half), Vector3::Constant(half));
}

// An object that turns leaves its tight bounds when their slack is used up. Are they likely to last so long that they pay?
bool tight_bounds_last(const Observation &seen, double step)
{
    return !seen.is_sphere && tuning::least_tight_ticks * step * seen.spin < tuning::slack_of_bounds;
}

// A rigid object stays within a ball that holds its bounding box once, however it turns: within the cube around that ball. Each
// prediction sees another box; the smallest cube that the object has not left is kept.
Box cube_to_turn_in(const ProxyRecord &last, const FloatBox &box)
{
    constexpr double margin = 1e-5; // for rounding as the object turns
    const float farthest_side =
        std::max(-*std::min_element(box.low, box.low + 3), *std::max_element(box.high, box.high + 3));
    const double corner = (1 + margin) * farthest_corner(box);
    const bool was_in_cube = last.kind.check == Check::bounds && !last.kind.tight_bounds_last;
    const float last_half = last.prediction.high[0];
    return cube(was_in_cube && farthest_side <= last_half ? std::min<double>(last_half, corner) : corner);
}
} // namespace

Vector3 centre_of(const Observation &seen)
{
    return seen.centre ? *seen.centre : finite_centre(*seen.bounds);
}

void set_extent(ProxyRecord &record, const Observation &seen, const Vector3 &centre, double step)
{
    const bool tight = tight_bounds_last(seen, step);
    FloatBox box = FloatBox::around(seen.bounds ? relative_to(centre, *seen.bounds) : cube(seen.radius));
    const bool has_sphere = std::isfinite(seen.radius);
    if (seen.bounds && seen.centre && !has_sphere && !tight && box.bounded())
        box = FloatBox::around(cube_to_turn_in(record, box));
    std::copy_n(box.low, 3, record.prediction.low);
    std::copy_n(box.high, 3, record.prediction.high);
    record.prediction.radius = round_up(seen.box_only ? std::numeric_limits<double>::infinity()
                                        : seen.bounds ? farthest_corner(box)
                                                      : seen.radius);
    record.kind.check = seen.bounds ? Check::bounds : Check::centre;
    record.kind.tight_bounds_last = tight;
}

double size_of(const ProxyRecord::Prediction &prediction)
{
    double sum = 0;
    int sides = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double extent = 0.5 * (double{prediction.high[axis]} - prediction.low[axis]);
        if (extent < 1e15)
        {
            sum += extent;
            ++sides;
        }
    }
    return sides > 0 ? sum / sides : 0;
}

bool is_bounded(const ProxyRecord::Prediction &prediction)
{
    const float *low = prediction.low, *high = prediction.high;
    return FloatBox{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}.bounded();
}
} // namespace ode_predictive_space
