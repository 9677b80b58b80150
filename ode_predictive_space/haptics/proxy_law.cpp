#include "ode_predictive_space/haptics/proxy_law.h"

#include <algorithm>

#include "ode_predictive_space/haptics/closest_point.h"
#include "ode_predictive_space/haptics/normal_force.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double rounding_of_planes = 1e-9; // of a plane that lies in the one that carries
} // namespace

ProxyLaw::ProxyLaw(const Material &material) : material_(material)
{
    check(material);
}

void ProxyLaw::forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces)
{
    planes_.swap(last_planes_);
    planes_.clear();
    for (const Touch &touch : touches)
        planes_.push_back(plane_of(tool.position, touch, dt));
    find_closest_point(planes_);

    Vector3 lifted = tool.position;
    double carried = 0; // m; what all planes lift together
    for (const ConstraintPlane &plane : planes_)
    {
        lifted += plane.share * plane.normal;
        carried += plane.share;
    }
    follow_materials(touches, dt);
    const Vector3 along = friction(tool.position, lifted, carried, touches, dt);
    proxy_ = lifted + along;
    has_proxy_ = proxy_.allFinite();

    forces.resize(touches.size());
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        const ConstraintPlane &plane = planes_[i];
        forces[i] =
            normal_force(tool, touches[i], materials_[i], plane.normal, plane.share, plane.share != 0) * plane.normal;
        if (carried > 0)
            forces[i] += materials_[i].stiffness * plane.share / carried * along;
    }
}

ConstraintPlane ProxyLaw::plane_of(const Vector3 &tool, const Touch &touch, double dt) const
{
    ConstraintPlane plane;
    plane.object = touch.object;
    plane.feature = touch.feature;
    plane.normal = touch.normal;
    plane.depth = touch.depth;
    plane.height = touch.normal.dot(tool) + touch.depth;

    if (touch.from_entry_side)
        return plane;

    const auto same_plane = [&](const ConstraintPlane &other) {
        return other.object == touch.object && other.feature == touch.feature;
    };
    const auto last = std::find_if(last_planes_.begin(), last_planes_.end(), same_plane);
    if (last == last_planes_.end() || !(last->normal.dot(touch.normal) < 0))
        return plane;

    // The back of the object is nearer now: the tool came through it. The surface in front has moved with the object.
    const double height = last->height + last->normal.dot(touch.surface_velocity) * dt;
    const double depth = height - last->normal.dot(tool);
    if (depth > 0)
    {
        plane.normal = last->normal;
        plane.depth = depth;
        plane.height = height;
    }
    return plane;
}

void ProxyLaw::follow_materials(const std::vector<Touch> &touches, double dt)
{
    carries_.clear();
    for (const ConstraintPlane &plane : planes_)
        carries_.push_back(plane.share > 0 ? 1 : 0);
    materials_.follow(touches, carries_, material_, dt);
}

bool ProxyLaw::has_friction() const
{
    return most_friction(false) > 0;
}

/// m; how far friction holds the proxy off the place above the tool.
double ProxyLaw::most_friction(bool slides) const
{
    double most = 0;
    for (std::size_t i = 0; i < planes_.size(); ++i)
    {
        const Material &material = materials_[i];
        const double coefficient = slides ? material.friction : std::max(material.friction, material.static_friction);
        most += coefficient * planes_[i].share;
    }
    return most;
}

Vector3 ProxyLaw::friction(const Vector3 &tool, const Vector3 &lifted, double carried,
                           const std::vector<Touch> &touches, double dt)
{
    const bool slid = slides_;
    slides_ = false;
    if (!has_friction() || !has_proxy_ || !(carried > 0))
        return Vector3::Zero();

    // Where the proxy would be had it stayed on the surfaces that carry it.
    Vector3 along = proxy_ - lifted;
    for (std::size_t i = 0; i < touches.size(); ++i)
        along += planes_[i].share / carried * dt * touches[i].surface_velocity;
    along = along_the_carriers(along);

    // As far as friction holds it, and nothing else is in the way.
    slides_ = along.norm() > most_friction(slid);
    double part = slides_ ? most_friction(true) / along.norm() : 1;
    for (const ConstraintPlane &plane : planes_)
    {
        const double into = -plane.normal.dot(along);
        const double room = std::max(0.0, plane.normal.dot(lifted - tool) - plane.depth);
        if (plane.share == 0 && into > rounding_of_planes * along.norm())
            part = std::min(part, room / into);
    }
    return part * along;
}

Vector3 ProxyLaw::along_the_carriers(Vector3 vector) const
{
    // Gram and Schmidt: a third normal leaves nothing, one that depends on those before it says nothing new.
    Vector3 axes[3];
    int count = 0;
    for (const ConstraintPlane &plane : planes_)
    {
        if (plane.share == 0 || count == 3)
            continue;
        Vector3 axis = plane.normal;
        for (int i = 0; i < count; ++i)
            axis -= axis.dot(axes[i]) * axes[i];
        if (axis.squaredNorm() < 1e-10)
            continue;
        axes[count++] = axis.normalized();
        vector -= vector.dot(axes[count - 1]) * axes[count - 1];
    }
    return vector;
}

void ProxyLaw::reset()
{
    planes_.clear();
    last_planes_.clear();
    materials_.reset();
    has_proxy_ = false;
    slides_ = false;
}

} // namespace ode_predictive_space::haptics
