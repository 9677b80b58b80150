// The touches of a tick, matched with those of the tick before.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_NUMBERED_TOUCHES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_NUMBERED_TOUCHES_H

#include "ode_predictive_space/haptics/touch.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// A touch, and its geom.
struct TouchOfGeom
{
    dGeomID geom;
    Touch touch;
};

/// Call order in each tick: renew(), add() for each touch, number().
class NumberedTouches
{
public:
    NumberedTouches();

    /// Begins a tick.
    void renew();

    void forget();

    void clear() { now_.clear(); }
    void add(dGeomID geom, const Touch &touch) { now_.push_back({geom, touch}); }

    /// Adds the former carriers. The proxy has left all surfaces, and their force fades while it moves to the tool.
    ///
    /// @param lag m; from the tool to the proxy.
    void add_carriers_of_before(const Vector3 &lag);

    /// Sets Touch::feature: a plane keeps its number from tick to tick, across triangles.
    void number();

    std::vector<TouchOfGeom> &now() { return now_; }

    const std::vector<TouchOfGeom> &before() const { return before_; }

private:
    std::vector<TouchOfGeom> now_;
    std::vector<TouchOfGeom> before_;
};
} // namespace ode_predictive_space::haptics

#endif
