#include "ode_predictive_space/haptics/proxy_law.h"

#include "ode_predictive_space/haptics/contact/material.h"
#include "ode_predictive_space/haptics/law/felt_materials.h"
#include "ode_predictive_space/haptics/law/normal_force.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double rounding_of_planes = 1e-9; // of a plane that lies in the one that carries
} // namespace

ProxyLaw::ProxyLaw(const Material &material) : material_(material), materials_(std::make_unique<FeltMaterials>())
{
    check(material);
}

ProxyLaw::~ProxyLaw() = default;

void ProxyLaw::forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces)
{
    carries_.clear();
    Vector3 lifted = tool.position;
    double carried = 0; // m; what all planes lift together
    for (const Touch &touch : touches)
    {
        carries_.push_back(carry_of(touch));
        lifted += carries_.back().share * touch.normal + carries_.back().lag;
        carried += carries_.back().share;
    }
    materials_->follow(touches, material_, dt);
    const Vector3 along = friction(tool.position, lifted, carried, touches, dt);
    proxy_ = lifted + along;
    has_proxy_ = proxy_.allFinite();

    forces.resize(touches.size());
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        const Touch &touch = touches[i];
        const Carry &carry = carries_[i];
        const Material &material = (*materials_)[i];
        forces[i] = normal_force(tool, touch, material, touch.normal, carry.share, carry.share != 0) * touch.normal +
                    material.stiffness * carry.lag;
        if (carried > 0)
            forces[i] += material.stiffness * carry.share / carried * along;
    }
}

/// m; how far friction holds the proxy off the place above the tool.
double ProxyLaw::most_friction(bool slides) const
{
    double most = 0;
    for (std::size_t i = 0; i < carries_.size(); ++i)
    {
        const Material &material = (*materials_)[i];
        const double coefficient = slides ? material.friction : std::max(material.friction, material.static_friction);
        most += coefficient * carries_[i].share;
    }
    return most;
}

Vector3 ProxyLaw::friction(const Vector3 &tool, const Vector3 &lifted, double carried,
                           const std::vector<Touch> &touches, double dt)
{
    const bool slid = slides_;
    slides_ = false;
    if (!(most_friction(false) > 0) || !has_proxy_ || !(carried > 0))
        return Vector3::Zero();

    // Where the proxy would be had it stayed on the surfaces that carry it.
    Vector3 along = proxy_ - lifted;
    for (std::size_t i = 0; i < touches.size(); ++i)
        along += carries_[i].share / carried * dt * touches[i].surface_velocity;
    along = along_the_carriers(touches, along);

    // As far as friction holds it, and nothing else is in the way.
    slides_ = along.norm() > most_friction(slid);
    double part = slides_ ? most_friction(true) / along.norm() : 1;
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        const double into = -touches[i].normal.dot(along);
        const double room = std::max(0.0, touches[i].normal.dot(lifted - tool) - touches[i].depth);
        if (carries_[i].share == 0 && into > rounding_of_planes * along.norm())
            part = std::min(part, room / into);
    }
    return part * along;
}

Vector3 ProxyLaw::along_the_carriers(const std::vector<Touch> &touches, Vector3 vector) const
{
    // Gram and Schmidt: a third normal leaves nothing, one that depends on those before it says nothing new.
    Vector3 axes[3];
    int count = 0;
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        if (carries_[i].share == 0 || count == 3)
            continue;
        Vector3 axis = touches[i].normal;
        for (int j = 0; j < count; ++j)
            axis -= axis.dot(axes[j]) * axes[j];
        if (axis.squaredNorm() < 1e-10)
            continue;
        axes[count++] = axis.normalized();
        vector -= vector.dot(axes[count - 1]) * axes[count - 1];
    }
    return vector;
}

void ProxyLaw::reset()
{
    materials_->reset();
    has_proxy_ = false;
    slides_ = false;
}
} // namespace ode_predictive_space::haptics
