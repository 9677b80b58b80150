// Geoms that the probe is in without having come through their surface.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_EXCLUDED_GEOMS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_EXCLUDED_GEOMS_H

#include "ode_predictive_space/haptics/contact/nearby_geom.h"

namespace ode_predictive_space::haptics
{
/// times the radius; a geom that carries the proxy farther in a tick was put elsewhere.
constexpr double farthest_carried = 10;

/// Where the probe is in a tick, and how it came there.
struct ProbePlace
{
    Vector3 centre = Vector3::Zero(); ///< m
    double radius = 0;                ///< m
    bool begins = false;              ///< it was not there in the tick before
    double tick = 0;                  ///< s; since the tick before
};

/// There is no side from which the probe came into such a geom, so that any force would be arbitrary: see TouchSensor. What came
/// around the probe by its own motion is not excluded.
///
/// Each tick: begin(), then excludes() for each geom that the near callback tells.
class ExcludedGeoms
{
public:
    ExcludedGeoms();

    /// A geom that is not told in a tick is excluded no more.
    void begin();

    /// For a geom whose surface is known.
    bool excludes(const NearbyGeom &geom, const ProbePlace &probe);

    /// For a geom that only dCollide() knows: it is excluded from the start alone.
    ///
    /// @param depth m; of the deepest contact.
    bool excludes(dGeomID geom, double depth, const ProbePlace &probe);

private:
    /// A geom that the near callback told, and the probe in it.
    struct Told
    {
        GeomIdentity geom;
        Vector3 centre = Vector3::Zero(); ///< m; the scene's frame
        Vector3 local = Vector3::Zero();  ///< m; the geom's frame
        bool excluded = false;
    };

    const Told *before(const GeomIdentity &geom) const;
    bool must_exclude(const NearbyGeom &geom, const ProbePlace &probe) const;

    std::vector<Told> told_;
    std::vector<Told> before_;
};
} // namespace ode_predictive_space::haptics

#endif
