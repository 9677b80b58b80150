// What is touched in a tick, as laws get it: which touch is which, and what holds the proxy off the tool.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MANIFOLD_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MANIFOLD_H

#include "ode_predictive_space/haptics/contact/closest_point.h"
#include "ode_predictive_space/haptics/touch.h"

#include <cmath>
#include <optional>
#include <vector>

namespace ode_predictive_space::haptics
{
/// The cosine below which two planes are two surfaces. From facet to facet of one surface the normal turns by less than 60
/// degrees, also around an edge that the tool crosses quickly; two walls of a channel, a floor and its wall differ by more.
constexpr double same_surface = 0.5;

/// Whether the second is a place in the plane of the first. Bodies that rest beside each other differ by less than 0.02 mm, and a step of that
/// height cannot be felt.
inline bool is_flush(const Vector3 &normal, const Vector3 &point, const Vector3 &other)
{
    return std::abs(normal.dot(other - point)) <= 2e-5;
}

/// The one place where a touch is compared with those of the tick before, and where the constraint is solved for touches that the
/// tracker did not make (see ContactTracker). What comes later goes by Touch::id, Touch::takes_over, Touch::part and Touch::carry.
class ContactManifold
{
public:
    ContactManifold();

    /// One tick. Gives each touch its id, what it takes over from, its part, its material (see blended()) and what it carries. Does
    /// not allocate when it has seen as many touches before.
    ///
    /// - A touch by which the tool is about to be pushed out at the back of a thin object is turned round to the side by which it
    ///   came, if all objects are seen together.
    /// - A contact begins at the surface and gets deeper by the motion of tool and surface. One that is deep from the beginning is an
    ///   object that appeared around the probe: its surface comes up through the tool within half a second. What the tool goes on
    ///   to from such an object rises on from there.
    ///
    /// @param dt s; since the tick before.
    /// @param gap s; how long a contact may have gone unnoticed; nothing: new touches are felt at once, however deep.
    void follow(const ToolState &tool, TouchView view, double dt, std::optional<double> gap,
                std::vector<Touch> &touches);

    /// The clutch was released: the force of each object that the next follow() touches rises from zero, as that of an object which appeared around
    /// the probe. There was no force on the hand before, so the full force of a deep touch would come at once. Objects that are touched later are
    /// felt in full.
    void release() { released_ = true; }

    /// Forget all touches: what is touched next is new.
    void reset()
    {
        before_.clear();
        lift_.setZero();
    }

private:
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

    std::vector<Touch> before_;             ///< of the tick before, as they were felt
    Vector3 tool_before_ = Vector3::Zero(); ///< m
    Vector3 lift_ = Vector3::Zero();        ///< m; from the tool to where the touches of this tick hold it, in full
    double jump_ = 0;                       ///< m; from the lift of the tick before
    std::vector<ConstraintPlane> planes_;
    std::uint32_t last_id_ = 0;
    bool released_ = false; ///< in this tick
};
} // namespace ode_predictive_space::haptics

#endif
