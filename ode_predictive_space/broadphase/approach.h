// When does one predicted object come near others?

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_APPROACH_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_APPROACH_H

#include <optional>

#include <Eigen/Core>

#include "ode_predictive_space/broadphase/proxy_store.h"
#include "ode_predictive_space/prediction/proximity.h"

namespace ode_predictive_space
{
/// box_proximity() of one proxy's envelope and those of many others, in single precision: three axes at a time and without
/// branches, and one object's half of the work is done once.
///
/// Like that it is never late to enter and never early to leave. The other way it may be, by as much as single precision can
/// be off: some millionths of the distances and sizes involved.
class Approach
{
public:
    /// @param proxies must stay as they are as long as this is used.
    /// @param now the tick from which times are counted.
    Approach(const ProxyStore &proxies, ProxyId id, Tick now);

    /// When it may be near the other, within the horizons of both; none when they stay apart that long.
    std::optional<ProximityInterval> to(ProxyId other) const;

private:
    using Axes = Eigen::Array4f; // x, y, z, and one for the deviation, or that means nothing
    struct Gaps;

    float age(ProxyId id) const;
    Axes rounding(ProxyId other, const Axes &offset, const Axes &terms) const;
    Gaps gaps(ProxyId other, float duration) const;

    const ProxyStore &proxies_;
    ProxyId id_;
    Tick now_;
    float age_;
    float reach_;                       // the deviation now
    Vector3 position_;                  // now
    Axes velocity_, half_acceleration_; // now; and minus what the deviation grows by
    Axes low_, high_;                   // relative to the position, and outwards by what rounding can do
    Axes speed_, bend_;                 // sizes of velocity, when it was predicted, and acceleration
    Axes double_rounding_;              // of positions in double precision
    float scene_rounding_;              // of what the scene computes, where that is in single precision
};
} // namespace ode_predictive_space

#endif
