// Whose force it is that the hand feels.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_FORCE_SHARES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_FORCE_SHARES_H

#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// Divides the force that the hand really got among the objects that made it, so that each of them gets the opposite of its part.
///
/// What a law wishes is shortened on its way to the device, and kept from changing too fast, which mixes it with the force of the
/// tick before, which other objects may have made. So the force is split into a W + b P, with W what is requested now and P what
/// was given before; each object gets a times its part of W and b times its part of P. Does not allocate when it has seen as many
/// touches before.
class ForceSplit
{
public:
    ForceSplit();

    /// @param requested N; one for each touch, and then those in free space, each of which has a share of its own.
    /// @param given N; what was written of their sum. All finite, the scene's frame.
    void split(const std::vector<Touch> &touches, const TouchForces &requested, const Vector3 &given);

    /// One for each touch, in their order, those in free space, then those of objects that were left but whose force is not gone yet. Their sum is
    /// what was given; there are none when nothing is touched or was before.
    const std::vector<ForceShare> &shares() const { return shares_; }

    /// No force, and no shares.
    void clear() { shares_.clear(); }

private:
    void add_rest(const Vector3 &given);

    std::vector<ForceShare> shares_;
    std::vector<ForceShare> before_;
};
} // namespace ode_predictive_space::haptics

#endif
