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
    Solid() : Solid(Shape::unknown) {}

    /// Unknown when the geom is of another class.
    static Solid of(dGeomID geom);

    bool is_known() const { return shape_ != Shape::unknown; }

    /// The place of its surface that is nearest. A point inside has a negative distance, and the normal is the way out.
    SurfaceFeature nearest(const Vector3 &point) const;

private:
    enum class Shape
    {
        unknown,
        box,
        capsule, ///< a sphere is one without length
        cylinder,
        half_space
    };

    explicit Solid(Shape shape, const Vector3 &size = Vector3::Zero()) : shape_(shape), size_(size) {}

    Shape shape_;
    Vector3 size_;      ///< m; half the sides of a box; else radius and half of the length. Of a half-space its normal
    double height_ = 0; ///< m; of a half-space's surface, along its normal
};
} // namespace ode_predictive_space::haptics

#endif
