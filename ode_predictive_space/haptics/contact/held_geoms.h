// The geoms around the probe, and where the proxy is with respect to each of them.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_HELD_GEOMS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_HELD_GEOMS_H

#include "ode_predictive_space/haptics/contact/nearby_geom.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// The geoms around the probe, to be handed from the scene's tracker to the servo's; it keeps the meshes alive.
struct NearbyGeoms
{
    std::vector<NearbyGeom> geoms;
    double time = 0; ///< s; when this was so
};

/// On which side of which geom the proxy is, to be handed from the servo's tracker to the scene's.
struct ContactMemory
{
    /// The place of the proxy beside one geom. The places differ only while several geoms squeeze the sphere.
    struct Place
    {
        GeomIdentity geom;
        Vector3 at = Vector3::Zero();    ///< m; the scene's frame
        Vector3 local = Vector3::Zero(); ///< m; the geom's frame
        double drift = 0;                ///< m; how far the geom carried the proxy in the last tick
        TriangleList triangles;          ///< touched
    };

    /// Makes room for as many as there can be, since the servo does not allocate.
    ContactMemory() { places.reserve(touch_capacity); }

    bool has_proxy = false;
    Vector3 proxy = Vector3::Zero(); ///< m; the scene's frame
    std::vector<Place> places;
};

/// A geom, and where the proxy is with respect to it.
struct HeldGeom
{
    NearbyGeom geom;
    double distance = 0;        ///< m; from the middle of the region, if the order goes by it
    ContactMemory::Place place; ///< when the tick began; after the proxy has followed, when it was over

    void put(const Vector3 &at)
    {
        place.at = at;
        place.local = geom.to_local(at);
    }
};

/// All of a tick, up to the capacity, the nearest first. Each tick: renew(), then add() for each geom.
class HeldGeoms
{
public:
    HeldGeoms();

    /// Forgets what is near, but not where the proxy is with respect to it.
    void renew();

    /// Forgets that, too.
    void forget();

    /// After renew(): another tracker, which has gone on meanwhile, knows where the proxy is.
    void adopt(const ContactMemory &memory);
    bool adopts() const { return adopts_; }

    /// @param start m; the proxy, with respect to a geom that was not near before. @param most_drift m; what has carried the proxy farther was
    ///        put elsewhere. @param distance m; farther geoms come later.
    void add(NearbyGeom geom, const Vector3 &start, double most_drift, double distance);

    bool has(dGeomID geom) const;

    /// In this tick.
    std::vector<HeldGeom> &list() { return list_; }
    const std::vector<HeldGeom> &list() const { return list_; }

    /// The places of the proxy in the last tick, one for each geom that was near then.
    const std::vector<ContactMemory::Place> &places_before() const { return before_; }

    /// That of one geom; 0 for one that was not near.
    const ContactMemory::Place *place_before(dGeomID geom) const;

    /// Whether there were more geoms in this tick than the capacity: the farthest ones were left out.
    bool exceeds_capacity() const { return exceeds_; }

private:
    std::vector<HeldGeom> list_;
    std::vector<ContactMemory::Place> before_;
    bool exceeds_ = false;
    bool adopts_ = false; ///< in this tick
};
} // namespace ode_predictive_space::haptics

#endif
