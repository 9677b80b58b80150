// Plain objects in the place of geoms: the scene of the broad phase in its tests.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_WORLD_H
#define ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_WORLD_H

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "ode_predictive_space/broadphase/broadphase.h"
#include "tests/broadphase/support/pairs.h"

namespace ode_predictive_space
{
struct Object
{
    Vector3 centre = Vector3::Zero();
    Vector3 half = Vector3::Constant(0.1);  ///< of its bounding box
    double radius = 0.2;                    ///< of its bounding sphere; infinite when it has none
    bool is_sphere = false;                 ///< then half is the radius
    std::optional<Vector3> velocity;        ///< per second, of its body; none without a body
    Vector3 displacement = Vector3::Zero(); ///< per tick
};

/// Objects that move, and the broad phase that is told of each change as it happens.
class World
{
public:
    /// Predicts from the first tick on.
    World() { broadphase.want_predictions(); }

    Broadphase broadphase;

    /// Seconds per tick; the broad phase is not told.
    static constexpr double step = 0.001;

    ProxyId add(const Object &object);
    void remove(ProxyId id);

    /// The object has been changed in some way that the space is told of.
    void touch(ProxyId id);
    void place(ProxyId id, const Vector3 &centre);

    /// Moves every object by its displacement and tells of those that have one.
    void advance();

    /// A tick and the report.
    Pairs tick();
    Pairs report();

    Object &object(ProxyId id) { return objects_[id]; }
    bool present(ProxyId id) const { return id < present_.size() && present_[id]; }
    std::vector<ProxyId> members() const;

    /// All overlapping pairs, by brute force.
    Pairs overlapping() const;

    /// What is wrong with the invariant, or nothing. The broad phase must be caught up.
    std::string violated_invariant();

    // What Broadphase asks.
    void prefetch(ProxyId) const {}
    void prefetch_pose(ProxyId) const {}
    void prefetch_velocity(ProxyId) const {}
    Vector3 position(ProxyId id) const { return objects_[id].centre; }
    const double *coordinates(ProxyId id) const { return objects_[id].centre.data(); }
    bool has_grown(ProxyId id, float radius) const { return !(objects_[id].radius <= radius); }
    Box bounds(ProxyId id) const
    {
        return Box(objects_[id].centre - objects_[id].half, objects_[id].centre + objects_[id].half);
    }
    void measure(ProxyId id, MeasuredBox &box) const { box = MeasuredBox(bounds(id)); }
    std::optional<Vector3> pivot(ProxyId id) const;
    Observation observe(ProxyId id, bool with_bounds) const;
    bool overlap(ProxyId first, ProxyId second) const;

private:
    std::vector<Object> objects_;
    std::vector<char> present_;
    std::vector<CandidatePair> room_;
};

/// A ball without rotation, carried by a body that moves by `displacement` per tick.
Object ball(const Vector3 &centre, double radius, const Vector3 &displacement);

/// A box with a body, or without.
Object box(const Vector3 &centre, const Vector3 &half, const Vector3 &displacement, bool with_body);

/// All that is below z = height.
Object floor_below(double height);
} // namespace ode_predictive_space

#endif
