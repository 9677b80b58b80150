// What is touched in a tick, as laws get it: which touch is which, and what holds the proxy off the tool.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MANIFOLD_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MANIFOLD_H

#include "ode_predictive_space/haptics/contact/constraint_plane.h"
#include "ode_predictive_space/haptics/contact/contact_birth.h"
#include "ode_predictive_space/haptics/touch.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// Numbers the planes of objects (Touch::feature), before the proxy's contact is anybody else's: a plane keeps its number from tick to
/// tick, however many triangles it goes over.
class FeatureNumbers
{
public:
    FeatureNumbers();

    /// A new tick: what was numbered is now of the tick before.
    void begin();

    /// Forget all planes.
    void reset();

    /// @param first of the touches that are to be numbered.
    void number(std::vector<Touch> &touches, std::size_t first);

private:
    /// Which plane of an object had which number.
    struct Known
    {
        std::uintptr_t object;
        unsigned number;
        Vector3 normal;
    };

    bool recognise_one(std::vector<Touch> &touches, std::size_t first) const;
    bool is_taken(std::uintptr_t object, unsigned number) const;

    std::vector<Known> now_;
    std::vector<Known> before_;
};

/// The one place where a touch is compared with those of the tick before, and where the constraint is solved for touches that the
/// tracker did not make (see ContactTracker). What comes later goes by Touch::id, Touch::takes_over, Touch::part and Touch::carry.
///
/// Each tick: recognise(), let_rise(), solve(). None allocates when it has seen as many touches before.
class ContactManifold
{
public:
    explicit ContactManifold();

    /// Gives each touch its id, and what it takes over from. A touch by which the tool is about to be pushed out at the back of a thin
    /// object is turned round to the side by which it came, if all objects are seen together.
    ///
    /// @param tool m, the scene's frame. @param dt s; since the tick before.
    void recognise(const Vector3 &tool, TouchView view, double dt, std::vector<Touch> &touches);

    /// Makes the depths of touches less whose object appeared around the probe. What the tool goes on to from such an object rises on
    /// from there.
    ///
    /// @param watches whether new touches are looked at. Those that are not are felt at once.
    void let_rise(const ContactBirth &birth, bool watches, double dt, std::vector<Touch> &touches);

    /// Gives each touch what it carries, and remembers all touches for the next tick.
    void solve(const Vector3 &tool, TouchView view, std::vector<Touch> &touches);

    /// Forget all touches: what is touched next is new.
    void reset() { before_.clear(); }

private:
    /// A touch of the tick before.
    struct Known
    {
        std::uintptr_t object;
        unsigned feature;
        std::uint32_t id;
        bool carries;
        Vector3 normal;
        Vector3 point;
        double height; ///< m; of its plane: normal . (a point on it)
        double depth;  ///< m; all of it
        double part;   ///< of it, that was felt
    };

    const Known *itself(const Touch &touch) const;
    const Known *carrier_before(const Touch &touch, TouchView view) const;
    const Known *object_before(const Touch &touch) const;
    const Known *taken_over_by(const Touch &touch) const;
    double handed_over(const Touch &touch) const;
    double part_of(const Touch &touch, const ContactBirth &birth, bool watches, double dt) const;
    void solve_together(std::vector<Touch> &touches);
    void solve_alone(std::vector<Touch> &touches, std::size_t first);
    void remember(const Vector3 &tool, const std::vector<Touch> &touches);

    std::vector<Known> before_;
    std::vector<double> depths_; ///< m; of the touches of this tick, before they were made less
    std::vector<ConstraintPlane> planes_;
    std::uint32_t last_id_ = 0;
};

/// Of touches of different objects that go on in one plane (flush tiles, a ridge made of two boxes), the deepest counts, and the
/// others carry nothing: by their edges alone, each would push again.
void count_flush_touches_once(std::vector<Touch> &touches);
} // namespace ode_predictive_space::haptics

#endif
