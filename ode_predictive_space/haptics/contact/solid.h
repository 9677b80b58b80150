// The primitives of ODE as solids: what of one is nearest to a point.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SOLID_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SOLID_H

#include "ode_predictive_space/haptics/contact/surface_feature.h"

#include <ode/collision.h>

namespace ode_predictive_space::haptics
{
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

    SurfaceFeature nearest_of_box(const Vector3 &point) const;
    SurfaceFeature nearest_of_cylinder(const Vector3 &point) const;

    Shape shape_;
    Vector3 size_;      ///< m; half the sides of a box; else radius and half of the length. Of a half-space its normal
    double height_ = 0; ///< m; of a half-space's surface, along its normal
};
} // namespace ode_predictive_space::haptics

#endif
