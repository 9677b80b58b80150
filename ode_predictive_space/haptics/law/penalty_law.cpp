#include "ode_predictive_space/haptics/penalty_law.h"

#include "ode_predictive_space/haptics/contact/material.h"
#include "ode_predictive_space/haptics/law/felt_materials.h"
#include "ode_predictive_space/haptics/law/normal_force.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
PenaltyLaw::PenaltyLaw(const Material &material) : material_(material), materials_(std::make_unique<FeltMaterials>())
{
    check(material);
}

PenaltyLaw::~PenaltyLaw() = default;

void PenaltyLaw::forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces)
{
    const Vector3 moved = tool.position - last_position_;
    last_position_ = tool.position;
    holds_.swap(last_holds_);
    holds_.clear();

    materials_->follow(touches, material_, dt);
    forces.resize(touches.size());
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        const Material &material = (*materials_)[i];
        const Carry carry = carry_of(touches[i]);
        const bool carried_by_others = !carry.carries() && touches[i].depth > 0;
        const double pressure =
            normal_force(tool, touches[i], material, touches[i].normal, carry.share, !carried_by_others);
        forces[i] = pressure * touches[i].normal + material.stiffness * carry.lag;
        if (std::max(material.friction, material.static_friction) > 0)
            forces[i] += friction_force(touches[i], material, pressure, moved, dt);
    }
}

const PenaltyLaw::Hold *PenaltyLaw::hold_before(const Touch &touch) const
{
    const auto found = std::find_if(last_holds_.begin(), last_holds_.end(), [&](const Hold &hold) {
        return touch.takes_over != 0 && hold.touch == touch.takes_over;
    });
    return found != last_holds_.end() ? &*found : nullptr;
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
        holds_.push_back({touch.id, stretch, slides});
    return -material.stiffness * stretch;
}

void PenaltyLaw::reset()
{
    last_holds_.clear();
    holds_.clear();
    materials_->reset();
}
} // namespace ode_predictive_space::haptics
