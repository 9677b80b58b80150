#include "demos/worlds/probe_force.h"

#include <algorithm>

namespace ode_predictive_space::worlds
{
void ProbeForce::touch(const dContactGeom *contacts, int count, dBodyID body)
{
    if (count == 0)
        return;
    const dContactGeom &deepest = *std::max_element(
        contacts, contacts + count, [](const dContactGeom &a, const dContactGeom &b) { return a.depth < b.depth; });
    const double magnitude = std::min(settings_.stiffness * deepest.depth, settings_.max_force);
    pushes_.push_back({body, from_ode(deepest.pos), magnitude * from_ode(deepest.normal)});
}

Vector3 ProbeForce::apply()
{
    Vector3 total = Vector3::Zero();
    for (const Push &push : pushes_)
        total += push.force;
    // Scaled as a whole, not clamped at the end: the force on the person stays opposite to the sum of the forces on objects.
    const double norm = total.norm();
    const double share = norm > settings_.max_force ? settings_.max_force / norm : 1;
    for (const Push &push : pushes_)
    {
        if (push.body != nullptr)
        {
            const Vector3 reaction = -share * push.force;
            dBodyAddForceAtPos(push.body, reaction.x(), reaction.y(), reaction.z(), push.point.x(), push.point.y(),
                               push.point.z());
        }
    }
    pushes_.clear();
    return share * total;
}
} // namespace ode_predictive_space::worlds
