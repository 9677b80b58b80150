// Contacts that begin deep.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_BIRTH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_BIRTH_H

#include "ode_predictive_space/haptics/touch.h"

namespace ode_predictive_space::haptics
{
/// A contact begins at the surface and gets deeper by the motion of tool and surface. One that is deep from the beginning was made so: an
/// object that appeared around the probe, or was put there. Its surface comes up through the tool within half a second, so
/// that the force rises slowly.
///
/// Of one tick, and without memory: ContactManifold knows which contacts there were.
class ContactBirth
{
public:
    /// @param gap s; how long a contact may have gone unnoticed.
    ContactBirth(const ToolState &tool, double gap) : tool_(tool), gap_(gap) {}

    /// Whether the tool can have come to a new touch by its own motion and that of the surface.
    ///
    /// @param handed_over m; how deep along the touch's normal the tool was in what it touched before.
    bool began_at_surface(const Touch &touch, double handed_over) const;

    /// The part of a depth that is felt, after a time dt: 0 to 1.
    static double risen(double part, double dt);

private:
    const ToolState &tool_;
    double gap_;
};
} // namespace ode_predictive_space::haptics

#endif
