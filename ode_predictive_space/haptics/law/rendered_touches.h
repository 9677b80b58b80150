// The touches of a tick as rendered: the law's forces, and each object's part of the given force.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_RENDERED_TOUCHES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_RENDERED_TOUCHES_H

#include "ode_predictive_space/haptics/contact/contact_manifold.h"
#include "ode_predictive_space/haptics/force_law.h"
#include "ode_predictive_space/haptics/law/force_shares.h"

namespace ode_predictive_space::haptics
{
/// Call order in each tick: take(), force(), give(). Does not allocate for a number of touches that it has seen before.
class RenderedTouches
{
public:
    RenderedTouches()
    {
        touches_.reserve(touch_capacity);
        forces_.reserve(touch_capacity);
    }

    void reset()
    {
        manifold_.reset();
        split_.clear();
    }

    std::vector<Touch> &take(const std::vector<Touch> &touches) { return touches_ = touches; }

    /// @param gap see ContactManifold::follow(). @param released whether the clutch was released in this tick.
    Vector3 force(ForceLaw &law, const ToolState &tool, double dt, std::optional<double> gap, bool released)
    {
        if (released)
            manifold_.release();
        manifold_.follow(tool, law.view(), dt, gap, touches_);
        law.forces(tool, touches_, dt, forces_);
        return sum_of(forces_);
    }

    /// @param given N; the written part of force(); zero also without force().
    void give(const Vector3 &given)
    {
        if (given.isZero(0))
            split_.clear();
        else
            split_.split(touches_, forces_, given);
    }

    const std::vector<ForceShare> &shares() const { return split_.shares(); }

private:
    std::vector<Touch> touches_;
    ContactManifold manifold_;
    TouchForces forces_; ///< N; by the law
    ForceSplit split_;
};
} // namespace ode_predictive_space::haptics

#endif
