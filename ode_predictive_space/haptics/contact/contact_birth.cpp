#include "ode_predictive_space/haptics/contact/contact_birth.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double rise_time = 0.5;     // s
constexpr double unnoticed = 1e-4;    // m
constexpr double of_the_motion = 3.0; // times
} // namespace

void ContactBirth::limit(const ToolState &tool, double gap, bool watches, double dt, std::vector<Touch> &touches)
{
    now_.swap(before_);
    now_.clear();
    bool all_of_it = true;
    for (Touch &touch : touches)
    {
        const double part = part_of(touch, tool, gap, watches, dt);
        now_.push_back({touch.object, touch.normal, touch.depth, part});
        if (part < 1)
        {
            touch.depth *= part;
            all_of_it = false;
        }
    }
    for (Touch &touch : touches)
        touch.is_solved = touch.is_solved && all_of_it; // else it was solved for other depths
}

double ContactBirth::part_of(const Touch &touch, const ToolState &tool, double gap, bool watches, double dt) const
{
    const auto known =
        std::find_if(before_.begin(), before_.end(), [&](const Known &other) { return other.object == touch.object; });
    if (known != before_.end())
        return std::min(1.0, known->part + dt / rise_time);
    return !watches || may_be_new(touch, tool, gap) ? 1 : 0;
}

/// The tool came to it, or goes on to it from what it touched before.
bool ContactBirth::may_be_new(const Touch &touch, const ToolState &tool, double gap) const
{
    const double moved = gap * (touch.surface_velocity - tool.linear_velocity).norm();
    double handed_over = 0; // m
    for (const Known &other : before_)
        handed_over = std::max(handed_over, other.depth * other.normal.dot(touch.normal));
    return touch.depth <= unnoticed + of_the_motion * moved + handed_over;
}

void ContactBirth::reset()
{
    now_.clear();
    before_.clear();
}
} // namespace ode_predictive_space::haptics
