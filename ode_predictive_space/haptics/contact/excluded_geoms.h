// Geoms that the probe is in without having come through their surface.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_EXCLUDED_GEOMS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_EXCLUDED_GEOMS_H

#include "ode_predictive_space/haptics/contact/nearby_geom.h"
#include "ode_predictive_space/haptics/contact/short_list.h"

namespace ode_predictive_space::haptics
{
/// radii; a geom that carries the proxy farther in a tick was put elsewhere.
constexpr double farthest_carried = 10;

struct ProbePlace
{
    Vector3 centre = Vector3::Zero(); ///< m
    double radius = 0;                ///< m
    bool begins = false;              ///< it was elsewhere in the tick before
    double tick = 0;                  ///< s; since the tick before
};

/// Such a geom has no side of entry, so any force would be arbitrary (see TouchSensor). A geom that moved around the probe is
/// not excluded. Call order in each tick: begin(), then excludes() for each geom of the near callback.
class ExcludedGeoms
{
public:
    /// Begins a tick. A geom that is not reported in it is no longer excluded.
    void begin() { reported_.begin(); }

    bool excludes(const NearbyGeom &geom, const ProbePlace &probe);

    /// For a geom that only dCollide() knows: excluded only when the probe begins in it.
    bool excludes(dGeomID geom, double depth, const ProbePlace &probe);

private:
    struct Reported
    {
        GeomIdentity geom;
        Vector3 centre = Vector3::Zero(); ///< m; the scene's frame
        Vector3 local = Vector3::Zero();  ///< m; the geom's frame
        bool excluded = false;
    };

    const Reported *before(const GeomIdentity &geom) const;
    bool must_exclude(const NearbyGeom &geom, const ProbePlace &probe) const;

    TwoTicks<Reported> reported_;
};
} // namespace ode_predictive_space::haptics

#endif
