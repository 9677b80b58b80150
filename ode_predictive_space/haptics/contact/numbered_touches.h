// The touches of a tick, and which of them is which of those of the tick before.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NUMBERED_TOUCHES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NUMBERED_TOUCHES_H

#include "ode_predictive_space/haptics/touch.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// A touch, and which of the object's geoms it is of.
struct TouchOfGeom
{
    dGeomID geom;
    Touch touch;
};

/// Each tick: renew(), then add() for each touch, number().
class NumberedTouches
{
public:
    NumberedTouches();

    /// A tick begins: the touches are those of the tick before.
    void renew();

    /// Forgets both.
    void forget();

    void clear() { now_.clear(); }
    void add(dGeomID geom, const Touch &touch) { now_.push_back({geom, touch}); }

    /// Adds the touches that carried the proxy in the last tick. The proxy has left all surfaces and moves to the tool; the force of these touches
    /// fades on the way.
    ///
    /// @param lag m; from the tool to the proxy.
    void add_carriers_of_before(const Vector3 &lag);

    /// Numbers the planes of objects (Touch::feature): a plane keeps its number from tick to tick, however many triangles it goes over.
    void number();

    std::vector<TouchOfGeom> &now() { return now_; }

    /// The touches of the last tick, with the numbers of their planes.
    const std::vector<TouchOfGeom> &before() const { return before_; }

private:
    std::vector<TouchOfGeom> now_;
    std::vector<TouchOfGeom> before_;
};
} // namespace ode_predictive_space::haptics

#endif
