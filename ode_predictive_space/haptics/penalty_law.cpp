#include "ode_predictive_space/haptics/penalty_law.h"

#include <algorithm>

#include "ode_predictive_space/haptics/closest_point.h"
#include "ode_predictive_space/haptics/normal_force.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double goes_on = 0.9; // cosine between the normals of planes of one surface
} // namespace

PenaltyLaw::PenaltyLaw(const Material &material) : material_(material)
{
    check(material);
}

void PenaltyLaw::forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces)
{
    const Vector3 moved = tool.position - last_position_;
    last_position_ = tool.position;
    holds_.swap(last_holds_);
    holds_.clear();

    share_ways_out(touches);
    pressed_.clear();
    for (const double depth : depths_)
        pressed_.push_back(depth > 0 ? 1 : 0);
    materials_.follow(touches, pressed_, material_, dt);
    forces.resize(touches.size());
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        const Material &material = materials_[i];
        const bool carried_by_others = depths_[i] == 0 && touches[i].depth > 0;
        const double pressure =
            normal_force(tool, touches[i], material, touches[i].normal, depths_[i], !carried_by_others);
        forces[i] = pressure * touches[i].normal;
        if (std::max(material.friction, material.static_friction) > 0)
            forces[i] += friction_force(touches[i], material, pressure, moved, dt);
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

/// Of the same plane, or of the plane of the object that it goes on from.
const PenaltyLaw::Hold *PenaltyLaw::hold_before(const Touch &touch) const
{
    const Hold *best = nullptr;
    double agreement = goes_on;
    for (const Hold &hold : last_holds_)
    {
        if (hold.object != touch.object)
            continue;
        if (hold.feature == touch.feature)
            return &hold;
        const double cosine = hold.normal.dot(touch.normal);
        if (cosine > agreement)
        {
            best = &hold;
            agreement = cosine;
        }
    }
    return best;
}

Vector3 PenaltyLaw::friction_force(const Touch &touch, const Material &material, double normal_force,
                                   const Vector3 &moved, double dt)
{
    const auto tangent = [&](const Vector3 &v) -> Vector3 { return v - v.dot(touch.normal) * touch.normal; };

    // A new touch takes hold where it is.
    Vector3 stretch = Vector3::Zero();
    bool slides = false;
    if (const Hold *before = hold_before(touch))
    {
        stretch = tangent(before->stretch + moved - touch.surface_velocity * dt);
        slides = before->slides;
    }

    const double sliding = material.friction * normal_force; // N
    const double most = slides ? sliding : std::max(material.static_friction, material.friction) * normal_force;
    const double pull = material.stiffness * stretch.norm();
    slides = pull > most;
    if (slides)
        stretch *= sliding / pull;
    if (normal_force > 0 && stretch.allFinite()) // else it starts anew
        holds_.push_back({touch.object, touch.feature, touch.normal, stretch, slides});
    return -material.stiffness * stretch;
}

void PenaltyLaw::reset()
{
    last_holds_.clear();
    holds_.clear();
    materials_.reset();
}

} // namespace ode_predictive_space::haptics
