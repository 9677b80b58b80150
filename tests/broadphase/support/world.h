// Plain objects in the place of geoms: the scene of the broad phase in its tests.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_WORLD_H
#define ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_WORLD_H

#include <array>
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
    /// Half sizes in its own axes. Of a sphere all are the radius; of a capsule the radius is in x and y, half the segment in z.
    Vector3 half = Vector3::Constant(0.1);
    double radius = 0.2;         ///< of its bounding sphere; infinite when it has none
    Watch formula = Watch::nothing; ///< of its bounding box, which the broad phase may compute itself; nothing: there is none
    std::optional<Vector3> velocity;        ///< per second, of its body; none without a body
    Vector3 displacement = Vector3::Zero(); ///< per tick
    bool enabled = true;                    ///< only then is it in reported pairs; changed without notice
    bool has_pose = true;                   ///< its pose can be read when its move is reported
    std::array<double, 12> rotation = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}; ///< three rows of four
};

/// Its bounding box in double precision.
Box bounds_of(const Object &object);

Solid solid_of(const Object &object);

/// What Broadphase::report_at_once() and report_closely() ask.
class Noticed
{
public:
    explicit Noticed(const Object &object) : object_(object) {}

    bool has_pose() const { return object_.has_pose; }
    const double *position() const { return object_.centre.data(); }
    const double *rotation() const { return object_.rotation.data(); }
    bool turns_safely() const { return std::isfinite(object_.radius); }
    Solid solid() const { return solid_of(object_); }
    double radius() const { return object_.radius; }

private:
    const Object &object_;
};

/// Objects that move, and the broad phase that is told of each change as it happens.
class World : public Scene
{
public:
    Broadphase broadphase;

    /// Seconds per tick; the broad phase is not told.
    static constexpr double step = 0.001;

    ProxyId add(const Object &object);
    void remove(ProxyId id);

    /// The object has been changed in some way that the space is told of.
    ///
    /// @return true when it counts as a move.
    bool touch(ProxyId id);
    void place(ProxyId id, const Vector3 &centre);
    /// Turns it about its centre, from its first orientation.
    void turn(ProxyId id, const Vector3 &axis, double angle);

    /// Moves every object by its displacement and tells of those that have one.
    void advance();

    /// A tick and the report.
    Pairs tick();
    /// The reported pairs of enabled objects; the broad phase is told of the others.
    Pairs report();

    Object &object(ProxyId id) { return objects_[id]; }
    const Object &object(ProxyId id) const { return objects_[id]; }
    bool present(ProxyId id) const { return id < present_.size() && present_[id]; }
    std::vector<ProxyId> members() const;

    /// All overlapping pairs of enabled objects, by brute force.
    Pairs overlapping() const;

    /// Pairs that are tested at each report.
    std::size_t tested_pairs() const { return broadphase.near_pairs() - broadphase.waiting_pairs(); }

    /// What is wrong with the invariant, or nothing. The broad phase must be up to date.
    std::string violated_invariant() const;
    /// The same between ticks, before new pairs were looked for.
    std::string misplaced_object() const;

    // What the broad phase asks.
    void measure(const ProxyId *ids, std::size_t count, Place *places, const Origin &origin) override;
    void observe(const ProxyId *ids, std::size_t count, Observation *seen, const Origin &origin) override;
    Box bounds(ProxyId id) override { return bounds_of(seen(id)); }
    SampledPose pose(ProxyId id) override;
    bool overlap(ProxyId first, ProxyId second) override { return boxes_and_spheres_overlap(first, second); }
    void find_disabled(const ProxyId *ids, std::size_t count, std::vector<ProxyId> &disabled) override;

private:
    /// An object that is asked about; it must be there.
    const Object &seen(ProxyId id) const;
    std::optional<Vector3> pivot_of(ProxyId id) const;
    Observation observation(ProxyId id) const;
    bool boxes_and_spheres_overlap(ProxyId first, ProxyId second) const;
    std::string wrong_pair(const Pairs &near) const;

    std::vector<Object> objects_;
    std::vector<char> present_;
    std::vector<CandidatePair> room_;
};

/// A ball without rotation, carried by a body that moves by `displacement` per tick.
Object ball(const Vector3 &centre, double radius, const Vector3 &displacement);

/// A capsule along its z axis, carried by a body.
Object capsule(const Vector3 &centre, double radius, double half_segment, const Vector3 &displacement);

/// The same as box(), but its bounding box follows from no formula.
Object block(const Vector3 &centre, const Vector3 &half, const Vector3 &displacement, bool with_body);

/// A box with a body, or without.
Object box(const Vector3 &centre, const Vector3 &half, const Vector3 &displacement, bool with_body);

/// All that is below z = height.
Object floor_below(double height);
} // namespace ode_predictive_space

#endif
