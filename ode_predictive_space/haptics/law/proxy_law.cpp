#include "ode_predictive_space/haptics/proxy_law.h"

#include "ode_predictive_space/haptics/contact/material.h"
#include "ode_predictive_space/haptics/law/normal_force.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double rounding_of_planes = 1e-9; // of the displacement along them
constexpr int most_sweeps = 8;              // over the touches

/// Gram-Schmidt projection on the planes that carry; dependent normals are skipped.
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

/// m; the depth behind a touch's plane of a displacement from the lifted tool.
double entry_of(const Vector3 &along, const Vector3 &lift, const Touch &touch)
{
    return -touch.normal.dot(along) - std::max(0.0, touch.normal.dot(lift) - touch.depth);
}

/// Pushes friction out of planes along their normals, so that a plane that differs from the carrying one by rounding
/// does not reduce it. In a corner where that does not converge, friction is shortened.
Vector3 kept_out(const std::vector<Touch> &touches, const Vector3 &lift, Vector3 along)
{
    for (int sweep = 0; sweep < most_sweeps; ++sweep)
        for (const Touch &touch : touches)
            along += std::max(0.0, entry_of(along, lift, touch)) * touch.normal;
    double part = 1;
    for (const Touch &touch : touches)
    {
        const double into = -touch.normal.dot(along);
        const double entry = entry_of(along, lift, touch);
        if (entry > rounding_of_planes * along.norm())
            part = std::min(part, 1 - entry / into);
    }
    return part * along;
}
} // namespace

ProxyLaw::ProxyLaw(const Material &material) : material_(material)
{
    check(material);
}

void ProxyLaw::forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces)
{
    Vector3 lifted = tool.position;
    double carried = 0; // m; the sum of the shares
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

/// m; the largest displacement of the proxy by friction.
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

    // The proxy of the tick before, moved with the surfaces that carry it.
    Vector3 along = proxy_ - lifted;
    for (const Touch &touch : touches)
        along += carry_of(touch).share / carried * dt * touch.surface_velocity;
    along = along_the_carriers(touches, along);

    slides_ = along.norm() > most_friction(touches, slid);
    const double part = slides_ ? most_friction(touches, true) / along.norm() : 1;
    return kept_out(touches, lifted - tool, part * along);
}

void ProxyLaw::reset()
{
    has_proxy_ = false;
    slides_ = false;
}
} // namespace ode_predictive_space::haptics
