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
/// Does not allocate when it has seen as many touches before.
class ContactBirth
{
public:
    /// One tick: makes depths less where they have to be. Constraints are to be solved after that.
    ///
    /// @param gap s; how long a contact may have gone unnoticed.
    /// @param watches whether new contacts are looked at. Those that are not are taken as they are.
    void limit(const ToolState &tool, double gap, bool watches, double dt, std::vector<Touch> &touches);

    /// Forget all contacts: what is touched next is new.
    void reset();

private:
    struct Known
    {
        std::uintptr_t object;
        Vector3 normal;
        double depth; ///< m; all of it
        double part;  ///< 0 to 1; of the depth
    };

    double part_of(const Touch &touch, const ToolState &tool, double gap, bool watches, double dt) const;
    bool may_be_new(const Touch &touch, const ToolState &tool, double gap) const;

    std::vector<Known> now_;
    std::vector<Known> before_;
};
} // namespace ode_predictive_space::haptics

#endif
