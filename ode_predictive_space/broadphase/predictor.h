// Second stage of the tick: a new path and envelope for an object, and how long and how closely to trust them.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICTOR_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_PREDICTOR_H

#include <array>
#include <optional>
#include <vector>

#include "ode_predictive_space/broadphase/proxy_store.h"
#include "ode_predictive_space/prediction/history.h"
#include "ode_predictive_space/prediction/step_estimate.h"

namespace ode_predictive_space
{
/// An object as it is now, seen by the predictor.
struct Observation
{
    std::optional<Vector3> centre; ///< what it turns around; finite. None when that is not known
    double radius;                 ///< of a sphere around it that holds the object; infinite when none is known
    bool is_sphere = false;        ///< that sphere's box is its bounding box
    bool box_only = false;     ///< no sphere may judge it: it can be touched outside of any that holds its bounding box
    std::optional<Box> bounds; ///< its bounding box; needed where centre or radius is not known
    std::optional<Vector3> velocity; ///< in the program's unit, if it has a body that tells
    double spin = 0;                 ///< angular speed of that body, in the same unit
};

/// Horizons in ticks.
struct HorizonBounds
{
    std::uint32_t min_ticks = 1;
    std::uint32_t max_ticks = 2048;
};

class Predictor
{
public:
    HorizonBounds horizon;

    /// Only every so many ticks do horizons end, unless that would shorten them by much: predictions that are due at the same
    /// tick cost less, as code, trees and what they find are fetched once for all.
    std::uint32_t gather = 1;

    /// How far velocities carry objects in a tick, as far as is known.
    StepEstimate step_estimate;

    /// Fixed deviations for objects of the environment and for interactive ones; none: they adapt.
    std::array<std::optional<Deviation>, 2> deviation;

    /// Makes a new prediction from `now` on and raises the proxy's generation. The old prediction, if there is one, tells
    /// how well the object keeps to its predictions.
    void predict(ProxyStore &proxies, ProxyId id, const Observation &seen, Tick now);

    /// Remembers where an interactive object is, between predictions.
    void remember(const ProxyStore &proxies, ProxyId id, const Vector3 &centre, Tick now);

    /// Forgets what it knows about a proxy that is removed.
    void forget(ProxyStore &proxies, ProxyId id);

    double step() const { return step_estimate.step(); }
    std::size_t bytes() const;

private:
    struct Outcome;
    struct Motion;

    Outcome judge(const ProxyStore &proxies, ProxyId id, const Vector3 &centre, Tick now) const;
    Motion motion_of_body(PackedBounds &bounds, const Outcome &outcome, const Vector3 &velocity);
    Motion motion_from_history(PackedBounds &bounds, const Outcome &outcome, const Vector3 &centre, Tick now);
    Motion estimate_motion(PackedBounds &bounds, const Outcome &outcome, const Observation &seen, const Vector3 &centre,
                           Tick now);
    std::uint32_t horizon_for(const PackedBounds &bounds, const Motion &motion, double size) const;
    Tick end_of_horizon(Tick now, std::uint32_t ticks) const;
    void adapt(PackedBounds &bounds, const Outcome &outcome, double speed, double size) const;
    Deviation allow(const PackedBounds &bounds, const Outcome &outcome, double size) const;
    History &history_of(PackedBounds &bounds);

    std::vector<History> histories_;
    std::vector<std::uint32_t> free_histories_;
};
} // namespace ode_predictive_space

#endif
