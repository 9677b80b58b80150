// Surfaces: what of one is nearest to a point, and the primitives of ODE as solids.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SOLID_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SOLID_H

#include "ode_predictive_space/haptics/device.h"

#include <ode/collision.h>
#include <vector>

namespace ode_predictive_space::haptics
{
/// A local minimum of the distance between a point and a surface. Lengths in m.
struct SurfaceFeature
{
    Vector3 point = Vector3::Zero();   ///< on the surface
    Vector3 normal = Vector3::UnitZ(); ///< of length 1; from the surface towards the point
    double distance = 0;               ///< below 0 inside of a solid
    int triangle = -1;                 ///< of a mesh: which one
};

using SurfaceFeatures = std::vector<SurfaceFeature>;

/// A box, sphere, capsule, cylinder or half-space, in its own frame.
class Solid
{
public:
    /// Unknown when the geom is of another class.
    static Solid of(dGeomID geom);

    /// @param radius m.
    static Solid sphere(double radius);

    /// Everything behind a plane through a point.
    static Solid half_space(const Vector3 &point, const Vector3 &normal);

    bool is_known() const { return class_ != unknown; }

    /// Whether it looks the same however it is turned.
    bool is_ball() const { return class_ == dSphereClass; }

    /// The place of its surface that is nearest. A point inside has a negative distance, and the normal is the way out.
    SurfaceFeature nearest(const Vector3 &point) const;

private:
    static constexpr int unknown = -1;

    int class_ = unknown; ///< ODE's
    /// m; half the sides of a box; else radius and half of the length, 0 of a sphere. Of a half-space its normal.
    Vector3 size_ = Vector3::Zero();
    double height_ = 0; ///< m; of a half-space's surface, along its normal
};
} // namespace ode_predictive_space::haptics

#endif
