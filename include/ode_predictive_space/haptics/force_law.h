// The interface of force laws.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_FORCE_LAW_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_FORCE_LAW_H

#include "ode_predictive_space/haptics/touch.h"

namespace ode_predictive_space::haptics
{
/// Computes forces from touches. One law belongs to one probe and is used from one thread.
///
/// A law computes the force on the probe. The touched object gets exactly the opposite at the touch's point, so forces
/// and reactions sum to zero.
///
/// Touch::material is limited to properties that the device can render (see Renderer). A law with other properties has
/// to ensure stability itself.
///
/// Real-time: forces() neither allocates nor locks for a number of touches that it has seen before.
class ForceLaw
{
public:
    virtual ~ForceLaw() = default;

    /// Computes the forces of a tick.
    ///
    /// @param touches as view() requests, in any order. Touches of one object hold off the tool together: carry_of()
    ///         gives each one's part of the shortest displacement out of all their planes.
    /// @param dt s since the call before, > 0.
    /// @param forces result, N: forces[i] is the force on the probe by touches[i]. Further entries are forces in free
    ///         space, such as those of a magnet, a viscous medium or a guide. They are rendered and limited like the
    ///         others, but no body gets the opposite. An entry keeps its index from tick to tick.
    virtual void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) = 0;

    /// The touches that the law needs.
    virtual TouchView view() const { return TouchView::each_object_alone; }

    /// Forgets the state of friction and proxy, after a jump of the tool.
    virtual void reset() = 0;

    /// The material of objects without one.
    virtual Material material() const = 0;

    /// One word for people and recordings. A law that wraps another one forwards it, as it does view().
    virtual const char *name() const { return "custom"; }
};

/// The sum of forces, N.
Vector3 sum_of(const TouchForces &forces);

/// Properties of a virtual coupling; all >= 0.
struct CouplingProperties
{
    double stiffness = 500;         ///< N/m
    double damping = 1;             ///< N s/m
    double angular_stiffness = 0.5; ///< N m/rad
    double angular_damping = 0.005; ///< N m s/rad
};
} // namespace ode_predictive_space::haptics

#endif
