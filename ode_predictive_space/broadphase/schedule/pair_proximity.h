// The time of proximity of two predicted objects: the one formula that the tick and all questions use.
//
// It is equation (1) of the paper by slabs: per axis |distance| <= half extents + R(t), over the chords of equation (6) and
// lowered by the whole chord error (docs/method.md). In: two envelopes. Out: when they may first overlap, and when they part.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SCHEDULE_PAIR_PROXIMITY_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SCHEDULE_PAIR_PROXIMITY_H

#include <optional>

#include "ode_predictive_space/broadphase/objects/proxy_store.h"
#include "ode_predictive_space/prediction/proximity.h"

namespace ode_predictive_space
{
/// When is a pair reported?
enum class ProximityTest
{
    box,    ///< when bounding boxes overlap
    sphere, ///< when bounding boxes and bounding spheres overlap
    shape   ///< when bounding boxes overlap, and the shapes, where they are known, may touch
};

/// One object, and when it meets others. Computed in single precision, three axes at a time and without branches; one object's
/// half of the work is done once.
///
/// An interval found is never late to enter and never early to leave. It may be too long by some millionths of the distances
/// and sizes involved.
class PairProximity
{
public:
    /// @param proxies must stay as they are as long as this is used.
    /// @param now the tick from which times are counted.
    PairProximity(const ProxyStore &proxies, ProxyId id, Tick now, ProximityTest test);

    /// When the object may be near the other, within the horizons of both; none when they stay apart that long.
    std::optional<ProximityInterval> to(ProxyId other) const;

private:
    struct Gaps;

    std::optional<ProximityInterval> of_boxes(ProxyId other) const;
    bool keeps_sphere(ProxyId id) const;
    std::optional<ProximityInterval> of_spheres(ProxyId other, const ProximityInterval &of_boxes) const;
    float age(ProxyId id) const;
    Float4 rounding(ProxyId other, Float4 offset, Float4 terms) const;
    Gaps gaps(ProxyId other, float duration) const;

    const ProxyStore &proxies_;
    ProxyId id_;
    Tick now_;
    ProximityTest test_;
    float age_;
    float reach_;                    // R(now)
    alignas(16) double position_[3]; // now
    float scene_rounding_;           // of the scene's coordinates, as a part of their size

    // The fourth lanes belong to the deviation, as if the object moved along a fourth axis, or mean nothing.
    Float4 velocity_, half_acceleration_; // now; fourth: minus what the deviation grows by
    Float4 low_, high_;                   // relative to the position, and outwards by rounding
    Float4 speed_, bend_;                 // sizes of velocity, when predicted, and of acceleration
    Float4 double_rounding_;              // of positions in double precision
};
} // namespace ode_predictive_space

#endif
