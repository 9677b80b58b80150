#include "ode_predictive_space/haptics/proxy_law.h"

#include "ode_predictive_space/haptics/contact/material.h"
#include "ode_predictive_space/haptics/law/normal_force.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double rounding_of_planes = 1e-9; // of a plane that lies in the one that carries

/// By Gram and Schmidt: a third normal leaves nothing, one that depends on those before it says nothing new.
Vector3 along_the_carriers(const std::vector<Touch> &touches, Vector3 vector)
{
    Vector3 axes[3];
    int count = 0;
    for (const Touch &touch : touches)
    {
        if (carry_of(touch).share == 0 || count == 3)
            continue;
        Vector3 axis = touch.normal;
        for (int j = 0; j < count; ++j)
            axis -= axis.dot(axes[j]) * axes[j];
        if (axis.squaredNorm() < 1e-10)
            continue;
        axes[count++] = axis.normalized();
        vector -= vector.dot(axes[count - 1]) * axes[count - 1];
    }
    return vector;
}
} // namespace

ProxyLaw::ProxyLaw(const Material &material) : material_(material)
{
    check(material);
}

void ProxyLaw::forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces)
{
    Vector3 lifted = tool.position;
    double carried = 0; // m; what all planes lift together
    for (const Touch &touch : touches)
    {
        const Carry carry = carry_of(touch);
        lifted += carry.share * touch.normal + carry.lag;
        carried += carry.share;
    }
    const Vector3 along = friction(tool.position, lifted, carried, touches, dt);
    proxy_ = lifted + along;
    has_proxy_ = proxy_.allFinite();

    forces.clear();
    for (const Touch &touch : touches)
    {
        const Carry carry = carry_of(touch);
        const Material material = touch.material.value_or(material_);
        forces.push_back(normal_force(tool, touch, material, carry.share != 0) * touch.normal +
                         material.stiffness * carry.lag);
        if (carried > 0)
            forces.back() += material.stiffness * carry.share / carried * along;
    }
}

/// m; how far friction holds the proxy off the place above the tool.
double ProxyLaw::most_friction(const std::vector<Touch> &touches, bool slides) const
{
    double most = 0;
    for (const Touch &touch : touches)
    {
        const Material material = touch.material.value_or(material_);
        const double coefficient = slides ? material.friction : std::max(material.friction, material.static_friction);
        most += coefficient * carry_of(touch).share;
    }
    return most;
}

Vector3 ProxyLaw::friction(const Vector3 &tool, const Vector3 &lifted, double carried,
                           const std::vector<Touch> &touches, double dt)
{
    const bool slid = slides_;
    slides_ = false;
    if (!(most_friction(touches, false) > 0) || !has_proxy_ || !(carried > 0))
        return Vector3::Zero();

    // Where the proxy would be had it stayed on the surfaces that carry it.
    Vector3 along = proxy_ - lifted;
    for (const Touch &touch : touches)
        along += carry_of(touch).share / carried * dt * touch.surface_velocity;
    along = along_the_carriers(touches, along);

    // As far as friction holds it, and nothing else is in the way.
    slides_ = along.norm() > most_friction(touches, slid);
    double part = slides_ ? most_friction(touches, true) / along.norm() : 1;
    for (const Touch &touch : touches)
    {
        const double into = -touch.normal.dot(along);
        const double room = std::max(0.0, touch.normal.dot(lifted - tool) - touch.depth);
        if (carry_of(touch).share == 0 && into > rounding_of_planes * along.norm())
            part = std::min(part, room / into);
    }
    return part * along;
}

void ProxyLaw::reset()
{
    has_proxy_ = false;
    slides_ = false;
}
} // namespace ode_predictive_space::haptics
