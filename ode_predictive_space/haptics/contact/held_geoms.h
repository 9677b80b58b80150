// The geoms around the probe, each with the place of the proxy beside it.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_HELD_GEOMS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_HELD_GEOMS_H

#include "ode_predictive_space/haptics/contact/nearby_geom.h"

#include <vector>

namespace ode_predictive_space::haptics
{
/// The places of the proxy that the servo's tracker gives to the scene's.
struct ContactMemory
{
    /// The place of the proxy beside one geom; places differ only while geoms squeeze the sphere.
    struct Place
    {
        GeomIdentity geom;
        Vector3 at = Vector3::Zero();    ///< m; the scene's frame
        Vector3 local = Vector3::Zero(); ///< m; the geom's frame
        double drift = 0;                ///< m; displacement of the proxy by the geom in the last tick
        TriangleList triangles;          ///< touched
    };

    /// Reserves the maximum, because the servo must not allocate.
    ContactMemory() { places.reserve(touch_capacity); }

    bool has_proxy = false;
    Vector3 proxy = Vector3::Zero(); ///< m; the scene's frame
    std::vector<Place> places;
};

struct HeldGeom
{
    NearbyGeom geom;
    double distance = 0;        ///< m; from the centre of the region
    ContactMemory::Place place; ///< at the beginning of the tick; after follow(), at its end

    void put(const Vector3 &at)
    {
        place.at = at;
        place.local = geom.to_local(at);
    }
};

/// The geoms of a tick up to the capacity, the nearest first. Call order: renew(), then add() for each geom.
class HeldGeoms
{
public:
    HeldGeoms();

    /// Forgets the geoms, but not the places.
    void renew();

    void forget();

    /// After renew(): takes the places of another tracker.
    void adopt(const ContactMemory &memory);
    bool adopts() const { return adopts_; }

    /// @param start m; the proxy beside a geom that was not near before. @param most_drift m; a geom that carried the
    ///         proxy farther was put elsewhere. @param distance m; the order of the geoms.
    void add(NearbyGeom geom, const Vector3 &start, double most_drift, double distance);

    bool has(dGeomID geom) const;

    std::vector<HeldGeom> &list() { return list_; }
    const std::vector<HeldGeom> &list() const { return list_; }

    const std::vector<ContactMemory::Place> &places_before() const { return before_; }

    /// The former place beside one geom; 0 for a geom that was not near.
    const ContactMemory::Place *place_before(dGeomID geom) const;

    bool exceeds_capacity() const { return exceeds_; }

private:
    std::vector<HeldGeom> list_;
    std::vector<ContactMemory::Place> before_;
    bool exceeds_ = false;
    bool adopts_ = false; ///< in this tick
};
} // namespace ode_predictive_space::haptics

#endif
