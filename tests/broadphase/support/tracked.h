// One object and its predictions, without the rest of a broad phase.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_TRACKED_H
#define ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_TRACKED_H

#include "ode_predictive_space/broadphase/predict/predictor.h"
#include "ode_predictive_space/broadphase/verify/checks.h"
#include "tests/broadphase/support/proxies.h"

namespace ode_predictive_space
{
/// Follows an object as the tick does: verify, and predict anew what broke or expired.
class Tracked
{
public:
    explicit Tracked(Predictor &predictor) : predictor_(predictor)
    {
        store.add();
        predictor_.resize(store.size());
    }

    /// The object is seen at its next tick. Its size stays the same as long as a prediction lasts.
    void see(const Observation &seen)
    {
        ++now;
        const bool known = store.predicted(0);
        const bool holds = known && inside(seen);
        violations += known && !holds;
        // Interactive objects are sampled at each tick.
        if (is_interactive(store.records[0].role) && !seen.bounds)
            predictor_.sample(store, 0, *seen.centre, now);
        if (holds && store.remaining(0, now) > 0)
            return;
        predict(seen);
    }

    void predict(const Observation &seen)
    {
        predictor_.predict(store, 0, seen, now);
        ++predictions;
    }

    bool inside(const Observation &seen) const
    {
        if (seen.bounds)
            return bounds_inside(store.envelope(0, now), *seen.bounds);
        return centre_inside(store.paths[0], seen.centre->data(),
                             store.records[0].kind.still ? store.paths[0].since : now);
    }

    const ProxyRecord &record() const { return store.records[0]; }
    const PackedPath &path() const { return store.paths[0]; }

    ProxyStore store;
    Tick now = 0xffffff00u;
    int violations = 0;
    int predictions = 0;

private:
    Predictor &predictor_;
};

inline Observation seen_ball(const Vector3 &centre, double radius, const Vector3 &velocity)
{
    Observation seen;
    seen.centre = centre;
    seen.radius = radius;
    seen.is_sphere = true;
    seen.velocity = velocity;
    return seen;
}

/// Without a body that tells its velocity.
inline Observation seen_alone(const Vector3 &centre, double radius)
{
    Observation seen = seen_ball(centre, radius, Vector3::Zero());
    seen.velocity.reset();
    return seen;
}

inline Observation seen_bounds(const Box &bounds)
{
    Observation seen;
    seen.radius = std::numeric_limits<double>::infinity();
    seen.bounds = bounds;
    return seen;
}
} // namespace ode_predictive_space

#endif
