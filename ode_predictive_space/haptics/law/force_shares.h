// Division of the written force among the objects that caused it, so that each gets the opposite of its part.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_FORCE_SHARES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_FORCE_SHARES_H

#include "ode_predictive_space/haptics/force_law.h"

namespace ode_predictive_space::haptics
{
/// Limits shorten a law's force, and mix it with the force of the tick before, which other objects may have caused. So the
/// force is split into a W + b P, with the requested force W and the former force P; each object gets a times its part of W and
/// b times its part of P. Does not allocate for a number of touches that it has seen before.
class ForceSplit
{
public:
    ForceSplit();

    /// @param requested N; one for each touch, then those in free space, each with a share.
    /// @param given N; the written part of their sum. All finite, in the scene's frame.
    void split(const std::vector<Touch> &touches, const TouchForces &requested, const Vector3 &given);

    /// One per touch in order, those in free space, then former objects whose force still fades. Their sum is the given force.
    const std::vector<ForceShare> &shares() const { return shares_; }

    void clear() { shares_.clear(); }

private:
    void add_rest(const Vector3 &given);

    std::vector<ForceShare> shares_;
    std::vector<ForceShare> before_;
};
} // namespace ode_predictive_space::haptics

#endif
