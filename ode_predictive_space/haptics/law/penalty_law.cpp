#include "ode_predictive_space/haptics/penalty_law.h"

#include "ode_predictive_space/haptics/contact/material.h"
#include "ode_predictive_space/haptics/contact/short_list.h"
#include "ode_predictive_space/haptics/law/normal_force.h"

namespace ode_predictive_space::haptics
{
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

    forces.clear();
    for (const Touch &touch : touches)
    {
        const Material material = touch.material.value_or(material_);
        const Carry carry = carry_of(touch);
        const bool carried_by_others = !carry.carries() && touch.depth > 0;
        const double pressure = normal_force(tool, touch, material, !carried_by_others);
        forces.push_back(pressure * touch.normal + material.stiffness * carry.lag);
        if (std::max(material.friction, material.static_friction) > 0)
            forces.back() += friction_force(touch, material, pressure, moved, dt);
    }
}

Vector3 PenaltyLaw::friction_force(const Touch &touch, const Material &material, double normal_force,
                                   const Vector3 &moved, double dt)
{
    const auto tangent = [&](const Vector3 &v) -> Vector3 { return v - v.dot(touch.normal) * touch.normal; };

    Vector3 stretch = Vector3::Zero();
    bool slides = false;
    const auto took_hold = [&](const Hold &hold) { return touch.takes_over != 0 && hold.touch == touch.takes_over; };
    if (const Hold *before = find_in(last_holds_, took_hold))
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
    if (normal_force > 0 && stretch.allFinite()) // otherwise the hold is lost
        holds_.push_back({touch.id, stretch, slides});
    return -material.stiffness * stretch;
}

void PenaltyLaw::reset()
{
    holds_.clear(); // the next tick's last_holds_
}
} // namespace ode_predictive_space::haptics
