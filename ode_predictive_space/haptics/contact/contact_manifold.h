// The touches of a tick as laws get them: their identities, and the constraint that holds the proxy off the tool.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MANIFOLD_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MANIFOLD_H

#include "ode_predictive_space/haptics/contact/closest_point.h"
#include "ode_predictive_space/haptics/touch.h"

#include <cmath>
#include <optional>
#include <vector>

namespace ode_predictive_space::haptics
{
/// The cosine below which two planes are different surfaces. Between facets of one surface the normal turns by less
/// than 60 degrees, even across an edge; a floor and its wall differ by more.
constexpr double same_surface = 0.5;

/// Whether the second point lies in the plane of the first, within 0.02 mm: a step of that height cannot be felt.
inline bool is_flush(const Vector3 &normal, const Vector3 &point, const Vector3 &other)
{
    return std::abs(normal.dot(other - point)) <= 2e-5;
}

/// Compares touches with those of the tick before, and solves the constraint for touches that the ContactTracker did
/// not make. All later stages use Touch::id, Touch::takes_over, Touch::part and Touch::carry.
class ContactManifold
{
public:
    ContactManifold();

    /// Processes a tick: sets each touch's id, takes_over, part, material (see blended()) and carry. Does not allocate for a
    /// number of touches that it has seen before.
    /// - If all objects are seen together, a touch that would push the tool out at the back of a thin object is turned to the
    ///   side of entry.
    /// - A contact that begins deeper than the motion of tool and surface explains belongs to an object that appeared around
    ///   the probe: its force rises within half a second, and touches that take over from it continue the rise.
    /// @param gap s; how long a contact may have gone unnoticed; without a value, new touches are rendered in full at once.
    void follow(const ToolState &tool, TouchView view, double dt, std::optional<double> gap,
                std::vector<Touch> &touches);

    /// The clutch was released: the force of each object in the next follow() rises from zero, because the hand had no
    /// force before. Objects that are touched later are rendered in full.
    void release() { released_ = true; }

    void reset()
    {
        before_.clear();
        lift_.setZero();
    }

private:
    const Touch *known_before(const Touch &touch);
    const Touch *carrier_before(const Touch &touch, TouchView view) const;
    const Touch *taken_over_by(const Touch &touch) const;
    void recognise(const Vector3 &tool, TouchView view, double dt, Touch &touch);
    double handed_over(const Touch &touch) const;
    double fastest_before(const ToolState &tool) const;
    double least_part_before() const;
    double part_of(const Touch &touch, const ToolState &tool, double dt, std::optional<double> gap) const;
    void note_lift(const std::vector<Touch> &touches);
    void let_rise(const ToolState &tool, TouchView view, double dt, std::optional<double> gap,
                  std::vector<Touch> &touches);
    void solve(TouchView view, double dt, std::vector<Touch> &touches);

    std::vector<Touch> before_;             ///< of the tick before, as rendered
    std::vector<bool> matched_;             ///< of before_: a touch of this tick continues it
    Vector3 tool_before_ = Vector3::Zero(); ///< m
    Vector3 lift_ = Vector3::Zero();        ///< m; from the tool to the proxy of this tick, without parts
    double jump_ = 0;                       ///< m; the change of the lift since the tick before
    std::vector<ConstraintPlane> planes_;
    std::uint32_t last_id_ = 0;
    bool released_ = false; ///< in this tick
};
} // namespace ode_predictive_space::haptics

#endif
