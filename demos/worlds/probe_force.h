// The force that a person feels through the probe, and its reaction on the touched objects.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_PROBE_FORCE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_PROBE_FORCE_H

#include "demos/worlds/vector.h"

#include <vector>

namespace ode_predictive_space::worlds
{
/// By default those of a PHANToM Desktop, with half of the stiffness that it can render.
struct ProbeForceSettings
{
    double stiffness = 500; ///< k, N/m
    double max_force = 7.9; ///< N
};

/// The penalty force of the paper: F = k d n for each touched object, d the depth of the deepest contact with it and n its
/// normal, towards the probe. Both each force and their sum are kept within the maximum; -F acts on the touched body.
class ProbeForce
{
public:
    explicit ProbeForce(const ProbeForceSettings &settings = {}) : settings_(settings) {}

    /// Add the contacts with one object, made by dCollide() with the probe first. `body` may be 0.
    void touch(const dContactGeom *contacts, int count, dBodyID body);

    /// Push the touched bodies and start again.
    ///
    /// @return the force on the probe, in N: minus the sum of the forces on the touched objects.
    Vector3 apply();

private:
    struct Push
    {
        dBodyID body; ///< 0 when the object has none
        Vector3 point;
        Vector3 force; ///< on the probe, N
    };

    ProbeForceSettings settings_;
    std::vector<Push> pushes_;
};
} // namespace ode_predictive_space::worlds

#endif
