// How a touch becomes a force: what every force law has in common.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_FORCE_LAW_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_FORCE_LAW_H

#include "ode_predictive_space/haptics/touch.h"

namespace ode_predictive_space::haptics
{
/// Turns what the probe touches into forces. One law belongs to one probe and is used from one thread.
///
/// A law only ever gives the force on the probe; whoever applies it gives the touched object exactly the opposite, at the
/// touch's point. Forces and reactions therefore add up to zero by construction.
///
/// Real-time: when forces() has seen a number of touches once, up to that number it neither allocates nor locks.
class ForceLaw
{
public:
    virtual ~ForceLaw() = default;

    /// One tick.
    ///
    /// @param touches as view() asks for; the order does not matter. Several of one object hold off the tool together: of the way
    ///        out of the object, which is the shortest behind none of their planes, each contributes a part along its normal.
    /// @param dt seconds since the call before, > 0.
    /// @param forces is made as long as touches: forces[i] is the force on the probe by touches[i].
    virtual void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) = 0;

    /// Which touches the law is to be given.
    virtual TouchView view() const { return TouchView::each_object_alone; }

    /// Forget what was felt before: friction's hold on a surface, the place of a proxy. After a jump of the tool.
    virtual void reset() = 0;

    /// N/m, in the scene's frame; of one surface along its normal.
    virtual double stiffness() const = 0;

    /// N s/m, in the scene's frame; 0 when it has none.
    virtual double damping() const = 0;

    /// For the stability check, which may find that stiffness() is too much for a device.
    ///
    /// @throws std::invalid_argument when it is negative or not finite.
    virtual void set_stiffness(double stiffness) = 0;
};

/// What the probe feels of several touches: the sum of their forces.
Vector3 sum_of(const TouchForces &forces);

/// What the penalty law and the proxy law can be set to.
struct SurfaceProperties
{
    double stiffness = 500; ///< N/m, >= 0
    double damping = 0;     ///< N s/m, >= 0; along the normal
    double friction = 0;    ///< Coulomb's coefficient, >= 0; the same for holding and for sliding
};

/// @throws std::invalid_argument that names the property which is negative or not finite.
void check(const SurfaceProperties &properties);
} // namespace ode_predictive_space::haptics

#endif
