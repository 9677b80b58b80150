// How a touch becomes a force: what every force law has in common.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_FORCE_LAW_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_FORCE_LAW_H

#include "ode_predictive_space/haptics/touch.h"

namespace ode_predictive_space::haptics
{
/// Turns what the probe touches into forces. One law belongs to one probe and is used from one thread.
///
/// A law gives only the force on the probe. The code that applies it gives the touched object exactly the opposite, at the
/// touch's point. Forces and reactions therefore add up to zero by construction.
///
/// What a touch feels like is in Touch::material, by then no more than the device can render (see Renderer): a law that goes by something
/// else has to see to stability itself.
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
    /// @param forces is made as long as touches: forces[i] is the force on the probe by touches[i]. It may be longer: each further entry is
    ///        a force in free space, such as that of a magnet, of a viscous medium or of a guide. The hand feels it as the others, limits
    ///        shorten it as the others, and no body gets the opposite. An entry keeps its place from tick to tick.
    virtual void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) = 0;

    /// Which touches the law is to be given.
    virtual TouchView view() const { return TouchView::each_object_alone; }

    /// Forget what was felt before: friction's hold on a surface, the place of a proxy. After a jump of the tool.
    virtual void reset() = 0;

    /// Of what has no material of its own.
    virtual Material material() const = 0;

    /// For people and recordings: one word. A law that wraps another one forwards it, as it does view().
    virtual const char *name() const { return "custom"; }
};

/// What the probe feels of several touches: the sum of their forces.
Vector3 sum_of(const TouchForces &forces);

/// What a virtual coupling can be set to; all >= 0.
struct CouplingProperties
{
    double stiffness = 500;         ///< N/m
    double damping = 1;             ///< N s/m
    double angular_stiffness = 0.5; ///< N m/rad
    double angular_damping = 0.005; ///< N m s/rad
};
} // namespace ode_predictive_space::haptics

#endif
