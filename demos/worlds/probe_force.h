#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_PROBE_FORCE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_PROBE_FORCE_H

#include "demos/worlds/vector.h"

#include <algorithm>
#include <vector>

namespace ode_predictive_space::worlds
{
/// The penalty force of the paper: F = k d n for each touched object, d the depth of the deepest contact with it and n its
/// normal, towards the probe. Both each force and their sum are kept within the maximum; -F acts on the touched body.
class ProbeForce
{
public:
    // The values of a PHANToM Desktop, with half of the stiffness that it can render.
    static constexpr double stiffness = 500; ///< k, N/m
    static constexpr double max_force = 7.9; ///< N

    /// Add the contacts with one object, made by dCollide() with the probe first. `body` may be 0.
    void touch(const dContactGeom *contacts, int count, dBodyID body);

    /// Pushes the touched bodies and starts again. @return the force on the probe, in N: minus the sum of those on the objects.
    Vector3 apply();

private:
    struct Push
    {
        dBodyID body; ///< 0: an object without a body
        Vector3 point;
        Vector3 force; ///< on the probe, N
    };

    std::vector<Push> pushes_;
};

inline void ProbeForce::touch(const dContactGeom *contacts, int count, dBodyID body)
{
    if (count == 0)
        return;
    const dContactGeom &deepest = *std::max_element(
        contacts, contacts + count, [](const dContactGeom &a, const dContactGeom &b) { return a.depth < b.depth; });
    const double magnitude = std::min(stiffness * deepest.depth, max_force);
    pushes_.push_back({body, from_ode(deepest.pos), magnitude * from_ode(deepest.normal)});
}

inline Vector3 ProbeForce::apply()
{
    Vector3 total = Vector3::Zero();
    for (const Push &push : pushes_)
        total += push.force;
    // Scaled as a whole, not clamped at the end: the force on the person stays opposite to the sum of the forces on objects.
    const double norm = total.norm();
    const double share = norm > max_force ? max_force / norm : 1;
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

#endif
