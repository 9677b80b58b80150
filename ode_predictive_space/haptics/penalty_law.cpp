#include "ode_predictive_space/haptics/penalty_law.h"

#include <algorithm>

#include "ode_predictive_space/haptics/check_argument.h"
#include "ode_predictive_space/haptics/closest_point.h"

namespace ode_predictive_space::haptics
{
PenaltyLaw::PenaltyLaw(const SurfaceProperties &properties) : properties_(properties)
{
    check(properties);
}

void PenaltyLaw::forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces)
{
    const Vector3 moved = tool.position - last_position_;
    last_position_ = tool.position;
    holds_.swap(last_holds_);
    holds_.clear();

    share_ways_out(touches);
    forces.resize(touches.size());
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        const double pressure = normal_force(tool, touches[i], depths_[i]);
        forces[i] = pressure * touches[i].normal;
        if (properties_.friction > 0)
            forces[i] += friction_force(touches[i], pressure, moved, dt);
    }
}

// Several planes of one object are one surface, whose way out they share.
void PenaltyLaw::share_ways_out(const std::vector<Touch> &touches)
{
    depths_.resize(touches.size());
    for (std::size_t first = 0; first < touches.size(); ++first)
    {
        const auto same_object = [&](const Touch &touch) { return touch.object == touches[first].object; };
        const auto begin = touches.begin() + static_cast<std::ptrdiff_t>(first);
        if (std::any_of(touches.begin(), begin, same_object))
            continue;
        planes_.clear();
        for (auto touch = begin; touch != touches.end(); ++touch)
            if (same_object(*touch))
            {
                planes_.emplace_back();
                planes_.back().normal = touch->normal;
                planes_.back().depth = touch->depth;
            }
        if (planes_.size() > 1)
            find_closest_point(planes_);
        else
            planes_[0].share = planes_[0].depth;
        std::size_t plane = 0;
        for (std::size_t i = first; i < touches.size(); ++i)
            if (same_object(touches[i]))
                depths_[i] = planes_[plane++].share;
    }
}

double PenaltyLaw::normal_force(const ToolState &tool, const Touch &touch, double depth) const
{
    const double spring = properties_.stiffness * depth;
    const bool carried_by_others = depth == 0 && touch.depth > 0;
    if (properties_.damping == 0 || carried_by_others)
        return spring;
    const double approach = (touch.surface_velocity - tool.linear_velocity).dot(touch.normal);
    const double force = spring + properties_.damping * approach;
    return force < 0 ? 0 : force; // what is not a number stays that
}

Vector3 PenaltyLaw::friction_force(const Touch &touch, double normal_force, const Vector3 &moved, double dt)
{
    const auto tangent = [&](const Vector3 &v) -> Vector3 { return v - v.dot(touch.normal) * touch.normal; };
    const auto same_plane = [&](const Hold &hold) {
        return hold.object == touch.object && hold.feature == touch.feature;
    };

    // A new touch takes hold where it is.
    Vector3 stretch = Vector3::Zero();
    const auto before = std::find_if(last_holds_.begin(), last_holds_.end(), same_plane);
    if (before != last_holds_.end())
        stretch = tangent(before->stretch + moved - touch.surface_velocity * dt);

    const double most = properties_.friction * normal_force; // N
    const double pull = properties_.stiffness * stretch.norm();
    if (pull > most)
        stretch *= most / pull;
    if (stretch.allFinite()) // else it starts anew
        holds_.push_back({touch.object, touch.feature, stretch});
    return -properties_.stiffness * stretch;
}

void PenaltyLaw::reset()
{
    last_holds_.clear();
    holds_.clear();
}

void PenaltyLaw::set_stiffness(double stiffness)
{
    check_not_negative(stiffness, "stiffness of a surface");
    properties_.stiffness = stiffness;
}
} // namespace ode_predictive_space::haptics
