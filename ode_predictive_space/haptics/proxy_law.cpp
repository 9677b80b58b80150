#include "ode_predictive_space/haptics/proxy_law.h"

#include <algorithm>

#include "ode_predictive_space/haptics/check_argument.h"
#include "ode_predictive_space/haptics/closest_point.h"

namespace ode_predictive_space::haptics
{
ProxyLaw::ProxyLaw(const SurfaceProperties &properties) : properties_(properties)
{
    check(properties);
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
    const Vector3 along = friction(tool.position, lifted, carried, touches, dt);
    proxy_ = lifted + along;
    has_proxy_ = proxy_.allFinite();

    forces.resize(touches.size());
    for (std::size_t i = 0; i < touches.size(); ++i)
    {
        forces[i] = normal_force(tool, touches[i], planes_[i]) * planes_[i].normal;
        if (carried > 0)
            forces[i] += properties_.stiffness * planes_[i].share / carried * along;
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

double ProxyLaw::normal_force(const ToolState &tool, const Touch &touch, const ConstraintPlane &plane) const
{
    const double spring = properties_.stiffness * plane.share;
    if (properties_.damping == 0 || plane.share == 0)
        return spring;
    const double approach = (touch.surface_velocity - tool.linear_velocity).dot(plane.normal);
    const double force = spring + properties_.damping * approach;
    return force < 0 ? 0 : force; // what is not a number stays that
}

Vector3 ProxyLaw::friction(const Vector3 &tool, const Vector3 &lifted, double carried,
                           const std::vector<Touch> &touches, double dt) const
{
    if (properties_.friction == 0 || !has_proxy_ || !(carried > 0))
        return Vector3::Zero();

    // Where the proxy would be had it stayed on the surfaces that carry it.
    Vector3 along = proxy_ - lifted;
    for (std::size_t i = 0; i < touches.size(); ++i)
        along += planes_[i].share / carried * dt * touches[i].surface_velocity;
    along = along_the_carriers(along);

    // As far as friction holds it, and nothing else is in the way.
    const double most = properties_.friction * carried;
    double part = along.norm() > most ? most / along.norm() : 1;
    for (const ConstraintPlane &plane : planes_)
    {
        const double into = -plane.normal.dot(along);
        const double room = std::max(0.0, plane.normal.dot(lifted - tool) - plane.depth);
        if (plane.share == 0 && into > 0)
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
    has_proxy_ = false;
}

void ProxyLaw::set_stiffness(double stiffness)
{
    check_not_negative(stiffness, "stiffness of a surface");
    properties_.stiffness = stiffness;
}
} // namespace ode_predictive_space::haptics
