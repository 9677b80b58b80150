// What two trackers of one contact tell each other: the scene's which geoms there are, the servo's where the proxy is.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MEMORY_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_CONTACT_MEMORY_H

#include "ode_predictive_space/haptics/contact/nearby_geom.h"

namespace ode_predictive_space::haptics
{
/// The geoms around the probe. Of fixed size, to be handed from thread to thread; it keeps the meshes alive.
struct NearbyGeoms
{
    static constexpr std::size_t capacity = 64;

    std::array<NearbyGeom, capacity> geoms;
    std::size_t count = 0;
    double time = 0; ///< s; when this was so
};

/// On which side of which geom the proxy is. Of fixed size, to be handed from thread to thread.
struct ContactMemory
{
    /// Where the proxy is with respect to a geom. The same place for all, but while geoms squeeze the sphere.
    struct Place
    {
        GeomIdentity geom;
        Vector3 at = Vector3::Zero();    ///< m; the scene's frame
        Vector3 local = Vector3::Zero(); ///< m; the geom's frame
        double drift = 0;                ///< m; how far the geom carried the proxy in the last tick
        TriangleList triangles;          ///< touched
    };

    bool has_proxy = false;
    Vector3 proxy = Vector3::Zero(); ///< m; the scene's frame
    std::array<Place, NearbyGeoms::capacity> places;
    std::size_t count = 0;
};
} // namespace ode_predictive_space::haptics

#endif
