// Features of surfaces near a point, and the primitives of ODE as solids.

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

class Solid
{
public:
    /// Reads a geom; unknown for other classes.
    static Solid of(dGeomID geom);

    static Solid sphere(double radius);

    static Solid half_space(const Vector3 &point, const Vector3 &normal);

    bool is_known() const { return class_ != unknown; }

    bool is_ball() const { return class_ == dSphereClass; }

    /// The nearest feature of the surface. Inside, the distance is negative and the normal points outwards.
    SurfaceFeature nearest(const Vector3 &point) const;

private:
    static constexpr int unknown = -1;

    int class_ = unknown; ///< ODE's
    /// m; half the sides of a box, radius and half length of a capsule or cylinder, radius of a sphere, normal of a half-space.
    Vector3 size_ = Vector3::Zero();
    double height_ = 0; ///< m; of a half-space's surface, along its normal
};
} // namespace ode_predictive_space::haptics

#endif
