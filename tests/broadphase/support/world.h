// The scene of the broad phase in its tests: plain objects in place of geoms.

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
    /// Half sizes along its own axes: for a sphere, the radius; for a capsule, the radius in x and y and half its segment in z.
    Vector3 half = Vector3::Constant(0.1);
    double radius = 0.2;                    ///< radius of the bounding sphere; infinite without one
    Watch formula = Watch::nothing;         ///< formula of its bounding box for the broad phase; nothing: no formula
    std::optional<Vector3> velocity;        ///< velocity of its body, per second; none without a body
    Vector3 displacement = Vector3::Zero(); ///< per tick
    bool enabled = true;                    ///< disabled objects are in no reported pair; changed without notice
    bool has_pose = true;                   ///< its pose can be read when its move is reported
    std::array<double, 12> rotation = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}; ///< three rows of four
};

Box bounds_of(const Object &object);

Solid solid_of(const Object &object);

/// An object as Broadphase::notify_at_once() and notify_closely() read it.
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

class World : public Scene
{
public:
    Broadphase broadphase;

    /// Seconds per tick, unknown to the broad phase.
    static constexpr double step = 0.001;

    ProxyId add(const Object &object);
    void remove(ProxyId id);

    /// Notifies the broad phase of a change. @return true if it counts as a move.
    bool touch(ProxyId id);
    void place(ProxyId id, const Vector3 &centre);
    /// Turns it about its centre. The angle is from its first orientation.
    void turn(ProxyId id, const Vector3 &axis, double angle);

    /// Moves every object by its displacement, and reports the moved ones.
    void advance();

    Pairs tick();
    /// The reported pairs of enabled objects. The disabled ones are made known to the broad phase.
    Pairs report();

    Object &object(ProxyId id) { return objects_[id]; }
    const Object &object(ProxyId id) const { return objects_[id]; }
    bool present(ProxyId id) const { return id < present_.size() && present_[id]; }
    std::vector<ProxyId> members() const;

    /// All overlapping pairs of enabled objects, by brute force.
    Pairs overlapping() const;

    std::size_t tested_pairs() const { return broadphase.near_pairs() - broadphase.waiting_pairs(); }

    /// A violation of the invariant, or an empty string. The broad phase must be up to date.
    std::string violated_invariant() const;
    /// As above between ticks, before the search for new pairs.
    std::string misplaced_object() const;

    void measure(const ProxyId *ids, std::size_t count, Place *places, const Origin &origin) override;
    void observe(const ProxyId *ids, std::size_t count, Observation *seen, const Origin &origin) override;
    Box bounds(ProxyId id) override { return bounds_of(seen(id)); }
    SampledPose pose(ProxyId id) override;
    bool overlap(ProxyId first, ProxyId second) override { return boxes_and_spheres_overlap(first, second); }
    void find_disabled(const std::vector<ProxyId> &ids, IdSet &disabled) override;

    // Objects have no shapes beyond their boxes.
    void follow(const ProxyId *, std::size_t, ConvexShape *const *, double *) override {}
    bool hull_is_outdated(ProxyId, const ConvexShape &) override { return false; }
    bool is_excluded(ProxyId, ProxyId) override { return false; }
    bool is_in_double_precision() const override { return true; }

private:
    /// The object that the broad phase asks about; it must be present.
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

Object capsule(const Vector3 &centre, double radius, double half_segment, const Vector3 &displacement);

/// As box(), without a formula for its bounding box.
Object block(const Vector3 &centre, const Vector3 &half, const Vector3 &displacement, bool with_body);

Object box(const Vector3 &centre, const Vector3 &half, const Vector3 &displacement, bool with_body);

Object floor_below(double height);
} // namespace ode_predictive_space

#endif
