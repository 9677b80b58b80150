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
    bool enabled = true;                    ///< only then is it in reported pairs; changed without notice
};

/// Objects that move, and the broad phase that is told of each change as it happens.
class World : public Scene
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
    /// The reported pairs of enabled objects; the broad phase is told of the others.
    Pairs report();

    Object &object(ProxyId id) { return objects_[id]; }
    bool present(ProxyId id) const { return id < present_.size() && present_[id]; }
    std::vector<ProxyId> members() const;

    /// All overlapping pairs of enabled objects, by brute force.
    Pairs overlapping() const;

    /// What is wrong with the invariant, or nothing. The broad phase must be up to date.
    std::string violated_invariant() const;

    // What the broad phase asks.
    void locate(const ProxyId *ids, std::size_t count, Location *locations) override;
    void measure(const ProxyId *ids, std::size_t count, MeasuredBox *boxes) override;
    void observe(const ProxyId *ids, std::size_t count, const bool *with_bounds, Observation *seen) override;
    Box bounds(ProxyId id) override { return box_of(id); }
    std::optional<Vector3> pivot(ProxyId id) override { return pivot_of(id); }
    bool overlap(ProxyId first, ProxyId second) override { return boxes_and_spheres_overlap(first, second); }
    void find_disabled(const ProxyId *ids, std::size_t count, std::vector<ProxyId> &disabled) override;

private:
    /// An object that is asked about; it must be there.
    const Object &seen(ProxyId id) const;
    Box box_of(ProxyId id) const;
    std::optional<Vector3> pivot_of(ProxyId id) const;
    Observation observation(ProxyId id, bool with_bounds) const;
    bool boxes_and_spheres_overlap(ProxyId first, ProxyId second) const;
    std::string misplaced_object() const;
    std::string wrong_pair(const Pairs &near) const;

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
